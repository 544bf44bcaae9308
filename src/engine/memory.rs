//! Memory that this process can still have, where the system tells. Rust ends a program that runs out of memory without
//! a word, so work that does not fit is refused before it begins.

/// Memory that reading and checking a file takes, in sizes of the file. Measured on the largest files of each form: a
/// body of 28 MB takes 245 MB.
const PER_BYTE_OF_FILE: f64 = 9.0;
/// Files up to this size are read without asking, bytes.
const SMALL_FILE: u64 = 1 << 20;

/// Memory that this process can still have, MB: the least that the system, the group of the process and its address
/// space leave.
#[must_use]
pub fn available_mb() -> Option<f64> {
    [free_of_system(), free_of_group(), free_of_address_space()].into_iter().flatten().reduce(f64::min)
}

/// Memory that a file of this size needs and what there is, MB, where it is too little.
#[must_use]
pub fn too_little_for_file(bytes: u64) -> Option<[f64; 2]> {
    if bytes <= SMALL_FILE {
        return None;
    }
    let needed = PER_BYTE_OF_FILE * mb(bytes);
    available_mb().filter(|free| needed > *free).map(|free| [needed, free])
}

#[expect(clippy::cast_precision_loss, reason = "sizes of memory in MB")]
fn mb(bytes: u64) -> f64 {
    bytes as f64 * 1e-6
}

/// A line such as `MemAvailable:  1234 kB` of a file of the system, MB.
fn kib_line(path: &str, name: &str) -> Option<f64> {
    let text = std::fs::read_to_string(path).ok()?;
    let line = text.lines().find_map(|l| l.strip_prefix(name))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1.024e-3)
}

fn free_of_system() -> Option<f64> {
    kib_line("/proc/meminfo", "MemAvailable:")
}

/// Containers limit the memory of a group of processes. A group without a limit says `max`, which is no number.
fn free_of_group() -> Option<f64> {
    let number = |name: &str| -> Option<u64> {
        std::fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok()?.trim().parse().ok()
    };
    Some(mb(number("memory.max")?.saturating_sub(number("memory.current")?)))
}

#[cfg(unix)]
fn free_of_address_space() -> Option<f64> {
    let most = rustix::process::getrlimit(rustix::process::Resource::As).current?;
    Some((mb(most) - kib_line("/proc/self/status", "VmSize:").unwrap_or(0.0)).max(0.0))
}

#[cfg(not(unix))]
fn free_of_address_space() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_larger_than_all_memory_is_refused_and_a_small_one_is_not_asked() {
        assert_eq!(too_little_for_file(SMALL_FILE), None);
        if let Some(free) = available_mb() {
            assert!(free > 1.0);
            let [needed, there] = too_little_for_file(u64::MAX / 2).expect("no system has as much");
            assert!(needed > there);
        }
    }
}
