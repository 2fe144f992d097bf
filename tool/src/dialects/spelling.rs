//! Guessing which word was meant.

/// The known name nearest to a misspelt one, if it is near enough to be meant; none where the name is itself a known
/// one, which is not misspelt but misplaced.
pub fn nearest(name: &str, known: &[&'static str]) -> Option<&'static str> {
    let distance = |known: &&str| edit_distance(name, known);
    known
        .iter()
        .copied()
        .min_by_key(distance)
        .filter(|known| (1..=known.len() / 3).contains(&distance(known)))
}

/// All known names that are as near to a misspelt one as the nearest, three at most; none where that is
/// too far to be meant.
pub fn nearest_ones(name: &str, known: &[&'static str]) -> Vec<&'static str> {
    let Some(nearest) = nearest(name, known) else {
        return Vec::new();
    };
    let least = edit_distance(name, nearest);
    let near = known
        .iter()
        .copied()
        .filter(|known| edit_distance(name, known) == least);
    near.take(3).collect()
}

/// How many similar names are told at most.
const FEW: usize = 3;

/// The known names nearest to one that is not known, the nearest first; names of which half would have to
/// be changed are not among them, unless that is a single character.
pub fn nearest_few<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let far = |known: &str| {
        let distance = edit_distance(name, known);
        let longer = known.chars().count().max(name.chars().count());
        (distance == 1 || 2 * distance < longer).then_some(distance)
    };
    let mut similar: Vec<(usize, &str)> = known
        .filter_map(|known| far(known).map(|distance| (distance, known)))
        .collect();
    similar.sort_unstable();
    similar.dedup();
    similar.truncate(FEW);
    similar.into_iter().map(|(_, known)| known).collect()
}

/// `did you mean #MSG, #CS?`: advice for a word that is not known; `None` where nothing is similar, or it stands there as it is
/// shown.
pub fn did_you_mean<'a>(
    name: &str,
    known: impl Iterator<Item = &'a str>,
    shown: impl Fn(&str) -> String,
) -> Option<String> {
    let similar: Vec<String> = nearest_few(name, known).into_iter().map(shown).collect();
    let stands_there = similar.first().is_some_and(|nearest| nearest == name);
    (!similar.is_empty() && !stands_there).then(|| format!("did you mean {}?", similar.join(", ")))
}

/// How many characters must be changed, added, taken out or swapped with their neighbour (optimal string
/// alignment).
fn edit_distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.iter().enumerate() {
        let mut next = vec![i + 1];
        for (j, to) in b.iter().enumerate() {
            let changed = row[j] + usize::from(from != to);
            let mut least = changed.min(row[j + 1] + 1).min(next[j] + 1);
            if i > 0 && j > 0 && a[i - 1] == *to && *from == b[j - 1] {
                least = least.min(before[j - 1] + 1);
            }
            next.push(least);
        }
        before = std::mem::replace(&mut row, next);
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
        assert_eq!(nearest("RTO", &known), Some("ROT"));
        assert_eq!(nearest("POCKET", &known), None);
    }

    #[test]
    fn the_nearest_come_first() {
        let known = ["MILL_12", "MILL_10", "DRILL_5", "FACE_MILL_10"];
        let few = |name| nearest_few(name, known.into_iter());
        assert_eq!(few("MILL_11"), ["MILL_10", "MILL_12"]);
        assert_eq!(few("MIL_10"), ["MILL_10", "MILL_12"]);
        assert!(few("TAP_M6").is_empty());
    }

    #[test]
    fn nobody_is_told_what_stands_there() {
        let known = ["CALL", "MCALL", "RCALL"];
        for name in known {
            assert_eq!(nearest(name, &known), None);
            assert!(nearest_ones(name, &known).is_empty());
            assert_eq!(did_you_mean(name, known.into_iter(), str::to_owned), None);
            let shown = did_you_mean(name, known.into_iter(), |known| format!("#{known}"));
            assert!(shown.is_some_and(|shown| shown.contains(&format!("#{name}"))));
        }
    }
}
