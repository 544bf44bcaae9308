//! "Did you mean": the known name closest to a misspelt one.

/// The closest name, if one is close enough to be meant.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (name.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|k| (strsim::damerau_levenshtein(name, k), k))
        .filter(|(distance, k)| {
            *distance <= limit || (k.len() > 3 && name.len() > 3 && (k.contains(name) || name.contains(k)))
        })
        .min()
        .map(|(_, k)| k)
}

/// The remedy for an unknown name: the nearest one, or all of them.
#[must_use]
pub fn remedy<'a>(name: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    if let Some(near) = nearest(name, known.clone()) {
        return format!("did you mean `{near}`?");
    }
    let all: Vec<String> = known.into_iter().map(|k| format!("`{k}`")).collect();
    if all.is_empty() { "there is none to choose from".to_owned() } else { format!("known are {}", all.join(", ")) }
}

/// The remedy for an unknown name where too many are known to list: the one that was meant, else the nearest three.
#[must_use]
pub fn remedy_of_many<'a>(name: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    if let Some(near) = nearest(name, known.clone()) {
        return format!("did you mean `{near}`?");
    }
    let mut all: Vec<(usize, &str)> = known.into_iter().map(|k| (strsim::damerau_levenshtein(name, k), k)).collect();
    all.sort_unstable();
    let near: Vec<String> = all.iter().take(3).map(|(_, k)| format!("`{k}`")).collect();
    format!("the nearest are {}", near.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_was_meant() {
        let stages = ["import-dxf", "triangulate", "drape"];
        assert_eq!(nearest("triangualte", stages), Some("triangulate"));
        assert_eq!(nearest("import", stages), Some("import-dxf"));
        assert_eq!(nearest("weld", stages), None);
        assert!(remedy("weld", stages).contains("`drape`"));
        assert_eq!(remedy_of_many("weld", stages).matches('`').count(), 6);
        assert_eq!(remedy_of_many("drap", stages), "did you mean `drape`?");
    }
}
