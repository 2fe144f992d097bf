//! Guessing which word was meant.

/// The known name nearest to a misspelt one, if it is near enough to be meant.
pub fn nearest(name: &str, known: &[&'static str]) -> Option<&'static str> {
    let distance = |known: &&str| edit_distance(name, known);
    known
        .iter()
        .copied()
        .min_by_key(distance)
        .filter(|known| distance(known) <= known.len() / 3)
}

/// How many characters must be changed, added or taken out (Levenshtein).
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let changed = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_are_recognised() {
        let known = ["TRANS", "MIRROR", "ROT"];
        assert_eq!(nearest("TRANZ", &known), Some("TRANS"));
        assert_eq!(nearest("MIROR", &known), Some("MIRROR"));
        assert_eq!(nearest("POCKET", &known), None);
    }
}
