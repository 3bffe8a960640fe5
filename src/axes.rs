//! The axes of the user: the letters and the order in which coordinates are shown, typed, read from lists and written.
//!
//! Inside, coordinates are right-handed and stand as X, Y, Z everywhere: X to the east, Y to the north, Z upwards, where they are geodetic at all.
//! Surveyors of some countries name the northing first. That is a matter of what people read, never of geometry: an exchange of two axes
//! would mirror the object. So everything that shows or writes a triple for people asks [`ShownAxes`] and nothing else exchanges columns;
//! drawings and files of other programs keep the right-handed system.
//!
//! The order exchanges two places at most, so it is its own inverse: what is typed is brought in by the same exchange.

use serde::{Deserialize, Serialize};

/// The axes of the user as the document keeps them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum UserAxes {
    /// East, north, height: X, Y, Z by the letters of surveyors.
    Enh,
    /// North, east, height: Y, X, Z of the right-handed system.
    Neh,
}

/// Letters and order of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShownAxes {
    letters: [&'static str; 3],
    order: [usize; 3],
}

impl ShownAxes {
    /// X, Y, Z as they are inside.
    pub const XYZ: Self = Self { letters: ["X", "Y", "Z"], order: [0, 1, 2] };

    /// Those of the user; none: X, Y, Z.
    pub fn of(axes: Option<UserAxes>) -> Self {
        let letters = ["E", "N", "H"];
        match axes {
            None => Self::XYZ,
            Some(UserAxes::Enh) => Self { letters, order: [0, 1, 2] },
            Some(UserAxes::Neh) => Self { letters, order: [1, 0, 2] },
        }
    }

    /// Which axis of the right-handed system each place of the user shows.
    pub fn order(self) -> [usize; 3] {
        self.order
    }

    /// Letter of an axis of the right-handed system; empty for what is none.
    pub fn letter(self, axis: usize) -> &'static str {
        self.letters.get(axis).copied().unwrap_or_default()
    }

    /// The letters in the order of the user.
    pub fn names(self) -> [&'static str; 3] {
        self.order.map(|axis| self.letters[axis])
    }

    /// The letters in the order of the user, as one text.
    pub fn list(self) -> String {
        self.names().join(", ")
    }

    /// A triple by the axes inside, in the order of the user.
    pub fn shown<T: Clone>(self, inside: [T; 3]) -> [T; 3] {
        self.order.map(|axis| inside[axis].clone())
    }

    /// A triple in the order of the user, by the axes inside.
    pub fn stored<T: Clone>(self, shown: [T; 3]) -> [T; 3] {
        self.shown(shown)
    }

    /// The upper triangle of a symmetric matrix (11, 12, 13, 22, 23, 33) by the axes inside, in the order of the user.
    pub fn shown_symmetric(self, [xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 6] {
        let full = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let at = |row: usize, column: usize| full[self.order[row]][self.order[column]];
        [at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)]
    }
}

impl Default for ShownAxes {
    fn default() -> Self {
        Self::XYZ
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_first_exchanges_letters_values_and_covariances_alike() {
        let axes = ShownAxes::of(Some(UserAxes::Neh));
        assert_eq!((axes.names(), axes.letter(0), axes.list().as_str()), (["N", "E", "H"], "E", "N, E, H"));
        assert_eq!(axes.shown(["east", "north", "height"]), ["north", "east", "height"]);
        // A covariance is that of the exchanged coordinates: C' = P C Pᵀ.
        assert_eq!(axes.shown_symmetric([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), [4.0, 2.0, 5.0, 1.0, 3.0, 6.0]);
        for axes in [None, Some(UserAxes::Enh), Some(UserAxes::Neh)].map(ShownAxes::of) {
            assert_eq!(axes.stored(axes.shown([1, 2, 3])), [1, 2, 3]);
        }
        assert_eq!(ShownAxes::of(None).names(), ["X", "Y", "Z"]);
        assert_eq!(serde_json::to_string(&UserAxes::Neh).unwrap(), "\"neh\"");
    }
}
