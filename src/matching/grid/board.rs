//! The board: which sites of a square lattice have a dot.
//!
//! Both kinds are parts of one square lattice with steps p and q. Symmetric: p is the column and q the row. Asymmetric: with x and y in
//! pitches, x = p - q and y = p + q, so that the dots of every other row stand between those of its neighbours.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Place, Reason, Result};
use crate::project::{Point, Role};

/// How the dots of a board stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BoardKind {
    /// Rows and columns at right angles: dot (i, j) at (j, i) pitches.
    #[default]
    Symmetric,
    /// Every other row is shifted by one pitch: dot (i, j) at (2 j + i mod 2, i) pitches, OpenCV's layout.
    Asymmetric,
}

/// A board of circular dots. Its coordinates: the first dot at (0, 0, 0), x along its row, y down the rows, z away from the viewer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Board {
    /// Number of rows.
    pub rows: u32,
    /// Number of dots in each row.
    pub columns: u32,
    /// Distance of two rows, in the unit of the project. On a symmetric board it is that of two columns too; on an asymmetric one the
    /// dots of a row are two pitches apart.
    pub pitch: f64,
    /// How the dots stand.
    #[serde(default)]
    pub kind: BoardKind,
    /// Diameter of the dots in the unit of the project, where it is known: it goes to the points, and tells this board from others.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// Standard error of each coordinate of a dot: the dots are control points; 0 holds them. Null: the dots are tie points, which
    /// start from the board's coordinates.
    #[serde(default)]
    pub sigma: Option<f64>,
    /// Place of an additional target beside the dots that shows which corner is the first, in the board's coordinates (x, y).
    #[serde(default)]
    pub mark: Option<[f64; 2]>,
}

/// A site of a lattice: number of steps p and q.
pub(super) type LatticeSite = [i32; 2];

/// Maximum number of dots of a board.
const DOTS: u32 = 10_000;

impl Board {
    /// Checks that it can be looked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming the field: fewer than 3 rows or columns (2 columns of an asymmetric board), more than 10 000 dots,
    /// a pitch or diameter that is not above 0, dots that overlap, a negative standard error, a mark that is not finite.
    pub fn check(&self) -> Result<()> {
        let invalid = |reason, field: &str| Err(Error::Invalid { reason, at: Place::field(field) });
        let columns = if self.kind == BoardKind::Asymmetric { 2 } else { 3 };
        if self.rows < 3 || self.rows > DOTS {
            return invalid(Reason::BoardSize { given: self.rows, needed: 3 }, "rows");
        }
        if self.columns < columns || self.columns > DOTS || self.rows * self.columns > DOTS {
            return invalid(Reason::BoardSize { given: self.columns, needed: columns }, "columns");
        }
        if !(self.pitch.is_finite() && self.pitch > 0.0) {
            return invalid(Reason::BoardPitch, "pitch");
        }
        if self.diameter.is_some_and(|d| !(d > 0.0 && d < self.pitch * self.step())) {
            return invalid(Reason::BoardDiameter, "diameter");
        }
        if self.sigma.is_some_and(|s| !(s.is_finite() && s >= 0.0)) {
            return invalid(Reason::NegativeSigma, "sigma");
        }
        if self.mark.is_some_and(|m| m.iter().any(|c| !c.is_finite())) {
            return invalid(Reason::NotFinite, "mark");
        }
        Ok(())
    }

    /// Length of a step of the lattice in pitches.
    pub(super) fn step(&self) -> f64 {
        if self.kind == BoardKind::Asymmetric { std::f64::consts::SQRT_2 } else { 1.0 }
    }

    /// Number of dots.
    pub(super) fn dots(&self) -> usize {
        (self.rows * self.columns) as usize
    }

    /// Row and column of the dot at a site, from 0; `None` if the board has no dot.
    pub(super) fn dot(&self, [p, q]: LatticeSite) -> Option<[u32; 2]> {
        let (row, column) = match self.kind {
            BoardKind::Symmetric => (q, p),
            BoardKind::Asymmetric => (p + q, (p - q).div_euclid(2)),
        };
        let inside = row >= 0 && column >= 0 && (row as u32) < self.rows && (column as u32) < self.columns;
        inside.then_some([row as u32, column as u32])
    }

    /// Site of a dot.
    pub(super) fn site(&self, [row, column]: [u32; 2]) -> LatticeSite {
        let (row, column) = (row as i32, column as i32);
        match self.kind {
            BoardKind::Symmetric => [column, row],
            BoardKind::Asymmetric => {
                let x = 2 * column + row % 2;
                [(x + row) / 2, (row - x).div_euclid(2)]
            }
        }
    }

    /// Whether a site is above, below, left or right of all dots.
    pub(super) fn sides(&self, [p, q]: LatticeSite) -> [bool; 4] {
        let (x, y, last) = match self.kind {
            BoardKind::Symmetric => (p, q, self.columns as i32 - 1),
            BoardKind::Asymmetric => (p - q, p + q, 2 * self.columns as i32 - 1),
        };
        [y < 0, y >= self.rows as i32, x < 0, x > last]
    }

    /// Sites of all dots, row by row.
    pub(super) fn sites(&self) -> impl Iterator<Item = LatticeSite> + '_ {
        (0..self.rows).flat_map(move |row| (0..self.columns).map(move |column| self.site([row, column])))
    }

    /// Place in the lattice of board coordinates (x, y), in steps.
    pub(super) fn lattice_from_board(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (x, y) = (x / self.pitch, y / self.pitch);
        match self.kind {
            BoardKind::Symmetric => [x, y],
            BoardKind::Asymmetric => [0.5 * (x + y), 0.5 * (y - x)],
        }
    }

    /// The object point of a dot.
    pub(super) fn point(&self, id: String, [row, column]: [u32; 2]) -> Point {
        let x = match self.kind {
            BoardKind::Symmetric => column,
            BoardKind::Asymmetric => 2 * column + row % 2,
        };
        Point {
            id,
            role: if self.sigma.is_some() { Role::Control } else { Role::Tie },
            xyz: Some([f64::from(x) * self.pitch, f64::from(row) * self.pitch, 0.0]),
            sigma: self.sigma.map(|s| [Some(s); 3]),
            diameter: self.diameter,
            normal: self.diameter.map(|_| [0.0, 0.0, 1.0]),
        }
    }
}
