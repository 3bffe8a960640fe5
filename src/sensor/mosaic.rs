//! Filters, levels and the lit part of a sensor.

use serde::{Deserialize, Serialize};

use crate::detection::Colour;

const LETTERS: [(char, Colour); 8] = [
    ('R', Colour::Red),
    ('G', Colour::Green),
    ('B', Colour::Blue),
    ('C', Colour::Cyan),
    ('M', Colour::Magenta),
    ('Y', Colour::Yellow),
    ('W', Colour::White),
    ('E', Colour::Emerald),
];

/// Longest side of a pattern.
const LONGEST: usize = 8;

/// Filters that repeat over the sensor, from its first site on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    width: usize,
    sites: Vec<Colour>,
}

impl Pattern {
    /// From one letter a site, row by row: "RGGB" with a width of 2. `None` for other letters and sizes.
    pub fn parse(letters: &str, width: usize) -> Option<Self> {
        let site = |letter: char| LETTERS.iter().find(|(known, _)| *known == letter).map(|(_, colour)| *colour);
        let sites: Vec<Colour> = letters.chars().map(site).collect::<Option<_>>()?;
        let fits = (1..=LONGEST).contains(&width) && !sites.is_empty() && sites.len().is_multiple_of(width);
        (fits && sites.len() / width <= LONGEST).then_some(Self { width, sites })
    }

    /// One letter a site, row by row.
    pub fn letters(&self) -> String {
        let letter =
            |site: &Colour| LETTERS.iter().find(|(_, colour)| colour == site).map_or('?', |(letter, _)| *letter);
        self.sites.iter().map(letter).collect()
    }

    /// Columns after which it repeats.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows after which it repeats.
    pub fn height(&self) -> usize {
        self.sites.len() / self.width
    }

    /// The filter of a site of the whole grid.
    #[inline]
    pub fn at(&self, x: usize, y: usize) -> Colour {
        self.sites[y % self.height() * self.width + x % self.width]
    }

    /// Whether a colour occurs.
    pub fn has(&self, colour: Colour) -> bool {
        self.sites.contains(&colour)
    }

    /// The colour with most sites.
    pub fn most(&self) -> Colour {
        let count = |colour: &Colour| self.sites.iter().filter(|site| *site == colour).count();
        self.sites.iter().copied().max_by_key(count).unwrap_or(Colour::White)
    }
}

impl Serialize for Pattern {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.letters(), self.width).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Pattern {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (letters, width) = <(String, usize)>::deserialize(deserializer)?;
        Self::parse(&letters, width).ok_or_else(|| serde::de::Error::custom("not a pattern of filters"))
    }
}

/// Level of a sample without light: a repeating pattern, and what rows and columns add.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Black {
    /// Columns after which the pattern repeats.
    pub width: usize,
    /// Row by row.
    pub levels: Vec<f64>,
    /// One a row of the grid, or none.
    pub rows: Vec<f64>,
    /// One a column of the grid, or none.
    pub columns: Vec<f64>,
}

impl Black {
    /// The same everywhere.
    pub fn uniform(level: f64) -> Self {
        Self { width: 1, levels: vec![level], ..Self::default() }
    }

    /// At a site of the whole grid.
    #[inline]
    pub fn at(&self, x: usize, y: usize) -> f64 {
        let height = self.levels.len() / self.width.max(1);
        let level = if height == 0 { 0.0 } else { self.levels[y % height * self.width + x % self.width] };
        let of = |list: &[f64], at: usize| if list.is_empty() { 0.0 } else { list.get(at).copied().unwrap_or(0.0) };
        level + of(&self.rows, y) + of(&self.columns, x)
    }

    /// Of the sites of one row.
    pub fn of_row(&self, y: usize) -> BlackRow<'_> {
        let height = self.levels.len() / self.width.max(1);
        let first = if height == 0 { 0 } else { y % height * self.width };
        let levels = self.levels.get(first..first + self.width).unwrap_or_default();
        BlackRow { levels, row: self.rows.get(y).copied().unwrap_or(0.0), columns: &self.columns }
    }

    /// The largest that occurs.
    pub fn largest(&self) -> f64 {
        let of = |list: &[f64]| list.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let more = |list: &[f64]| if list.is_empty() { 0.0 } else { of(list).max(0.0) };
        of(&self.levels).max(0.0) + more(&self.rows) + more(&self.columns)
    }

    fn is_sound(&self) -> bool {
        let finite = |list: &[f64]| list.iter().all(|level| level.is_finite());
        let whole = self.levels.is_empty() || self.width > 0 && self.levels.len().is_multiple_of(self.width);
        whole && finite(&self.levels) && finite(&self.rows) && finite(&self.columns)
    }
}

/// The black of one row.
#[derive(Clone, Copy, Debug)]
pub struct BlackRow<'a> {
    levels: &'a [f64],
    row: f64,
    columns: &'a [f64],
}

impl BlackRow<'_> {
    /// At a column of the whole grid.
    #[inline]
    pub fn at(&self, x: usize) -> f64 {
        let level = match self.levels {
            [] => 0.0,
            [only] => *only,
            levels => levels[x % levels.len()],
        };
        level + self.row + if self.columns.is_empty() { 0.0 } else { self.columns.get(x).copied().unwrap_or(0.0) }
    }
}

/// How the samples of a sensor are to be understood.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mosaic {
    /// The filters.
    pub pattern: Pattern,
    /// The part that light reaches: left, top, width, height.
    pub active_area: [u32; 4],
    /// Samples without light.
    pub black: Black,
    /// Sample from which more light makes no difference.
    pub white: f64,
}

impl Mosaic {
    /// Itself where it can be: the lit part inside the grid, black below white, and black of every row and column or of none: what
    /// a list does not reach would count as 0.
    pub(super) fn checked(self, [width, height]: [u32; 2]) -> Option<Self> {
        let [left, top, across, down] = self.active_area;
        let inside =
            |first: u32, count: u32, size: u32| count > 0 && first.checked_add(count).is_some_and(|e| e <= size);
        let whole = |list: &[f64], size: u32| list.is_empty() || list.len() == size as usize;
        let black = whole(&self.black.rows, height) && whole(&self.black.columns, width);
        let levels = black && self.black.is_sound() && self.white.is_finite() && self.white > self.black.largest();
        (levels && inside(left, across, width) && inside(top, down, height)).then_some(self)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn a_pattern_repeats_from_the_first_site_on() {
        let pattern = Pattern::parse("GRBG", 2).expect("a pattern");
        assert_eq!([pattern.at(0, 0), pattern.at(3, 4), pattern.at(2, 5)], [Colour::Green, Colour::Red, Colour::Blue]);
        assert_eq!((pattern.letters().as_str(), pattern.most()), ("GRBG", Colour::Green));
        for (letters, width) in [("", 1), ("RGB", 2), ("RGX", 3), ("RGGB", 0), ("GGGGGGGGG", 9), ("GGGGGGGGG", 1)] {
            assert!(Pattern::parse(letters, width).is_none(), "{letters}");
        }
    }

    #[test]
    fn black_of_some_rows_or_columns_only_is_refused() {
        let mosaic = |rows: usize, columns: usize| Mosaic {
            pattern: Pattern::parse("RGGB", 2).expect("a pattern"),
            active_area: [0, 0, 6, 4],
            black: Black { rows: vec![1.0; rows], columns: vec![1.0; columns], ..Black::uniform(10.0) },
            white: 100.0,
        };
        for rows in 0..7 {
            for columns in 0..9 {
                let whole = matches!(rows, 0 | 4) && matches!(columns, 0 | 6);
                assert_eq!(mosaic(rows, columns).checked([6, 4]).is_some(), whole, "{rows} {columns}");
            }
        }
    }

    #[test]
    fn black_adds_its_parts() {
        let black = Black { width: 2, levels: vec![1.0, 2.0, 3.0, 4.0], rows: vec![0.0, 10.0], columns: vec![] };
        assert_eq!([black.at(0, 0), black.at(3, 1), black.at(2, 3), black.largest()], [1.0, 14.0, 3.0, 14.0]);
        assert_eq!(Black::default().at(5, 5), 0.0);
        let same = |black: &Black| (0..4).all(|y| (0..4).all(|x| black.of_row(y).at(x) == black.at(x, y)));
        assert!(same(&black) && same(&Black::default()) && same(&Black::uniform(3.0)));
    }
}
