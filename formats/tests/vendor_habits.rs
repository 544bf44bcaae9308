//! More than fifty small files in the habits of pattern systems, with facts worked out by hand.
//!
//! Most hold the same two pieces: a rectangle of 300 × 600 mm (1800 cm², 1800 mm round), and a second one. The second
//! has a wedge of 30 × 100 mm in its upper edge (1785 cm²; 1800 − 30 + 2·√(15² + 100²) = 1972.2375 mm round).

mod habits;

use habits::facts::check;

#[test]
fn files_in_the_habits_of_their_writers() {
    let cases = habits::all();
    assert!(cases.len() >= 50, "{}", cases.len());
    let mut faults = Vec::new();
    for case in &cases {
        faults.extend(check(case).into_iter().map(|f| format!("{}: {f}", case.name)));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
