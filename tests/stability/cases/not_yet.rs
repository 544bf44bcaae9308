//! Cases of the catalogue that the program cannot run yet; they are in no count.

/// Cases, and what they wait for.
const LIST: [(&str, &str); 0] = [];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<24} {why}")).collect();
    format!("\nnot possible yet, counted nowhere:\n{}", lines.join("\n"))
}
