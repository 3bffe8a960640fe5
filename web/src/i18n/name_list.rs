//! Lists of names in sentences.

use super::en::errors::and_more;

/// Names that are written out.
const NAMED: usize = 8;

/// Names separated by commas; those beyond the first eight are counted.
pub fn name_list<Name: AsRef<str>>(names: impl IntoIterator<Item = Name>) -> String {
    let mut names = names.into_iter();
    let first = names.by_ref().take(NAMED).map(|name| name.as_ref().to_owned()).collect::<Vec<_>>().join(", ");
    match names.count() {
        0 => first,
        more => and_more(first, more),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_beyond_the_first_eight_are_counted() {
        assert_eq!(name_list(["a"; 0]), "");
        assert_eq!(name_list(["a", "b"]), "a, b");
        assert_eq!(name_list(["a"; 8]), "a, a, a, a, a, a, a, a");
        assert_eq!(name_list(["a"; 10]), "a, a, a, a, a, a, a, a and 2 more");
    }
}
