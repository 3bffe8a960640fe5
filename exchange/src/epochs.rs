//! Epochs of other programs: coordinate lists with standard errors, and covariance matrices as text.
//!
//! A coordinate list is a table of id, X, Y, Z and a standard error for each axis, read as [`control_csv`] reads tables: the export of
//! V-STARS (`NAME,X,Y,Z,sX,sY,sZ,…`), of JAG3D or of a spreadsheet. A matrix is rows of numbers: all in full, or the lower triangle with
//! the diagonal, `#` or `%` before comments; a heading may name the points, one or three columns each.

use serde::{Deserialize, Serialize};

use super::control_csv::{self, Assumption, TableChoices};
use super::text;
use sightline::error::{Error, Lack, Place, Reason, Result};
use sightline::monitoring::{ListedCovariance, ListedPoint};

/// A coordinate list.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CoordinateList {
    /// Its points.
    pub points: Vec<ListedPoint>,
    /// Unit, where the heading or the caller names one.
    pub unit: Option<String>,
    /// How the table was read.
    pub assumptions: Vec<Assumption>,
}

/// Reads a coordinate list.
///
/// # Errors
/// [`Error::Invalid`] with line and field, and for latitudes and longitudes without a local system, which is one for all epochs;
/// [`Error::Empty`] without points.
pub fn points(text: &str, choices: TableChoices) -> Result<CoordinateList> {
    let table = control_csv::parse_with(text, choices).in_given_system()?;
    let (unit, assumptions) = (table.unit.map(|unit| unit.symbol().to_owned()), table.assumptions.clone());
    let points = table.into_points()?.into_iter().map(|point| {
        let sigma = point.sigma.and_then(|sigma| match sigma {
            [Some(x), Some(y), Some(z)] => Some([x, y, z]),
            _ => None,
        });
        let xyz = point.xyz.ok_or_else(|| {
            let reason = Reason::Missing { name: "X, Y or Z".into() };
            Error::Invalid { reason, at: Place::point(point.id.clone()) }
        })?;
        Ok(ListedPoint { id: point.id, xyz, sigma })
    });
    Ok(CoordinateList { points: points.collect::<Result<_>>()?, unit, assumptions })
}

/// Reads a covariance matrix of points, three rows each in their order; a heading of the text overrides `names`.
///
/// # Errors
/// [`Error::Invalid`] with the line of a field that is not a number, or if the number of rows does not match the points.
pub fn covariance(text: &str, names: &[String]) -> Result<ListedCovariance> {
    let mut rows = text::rows(text);
    let mut points = names.to_vec();
    // A heading has no numbers in it, or is a row more than a full matrix has.
    let words = |row: &text::Row| row.fields.iter().any(|field| text::number(field).is_none());
    if rows.first().is_some_and(words) {
        let heading = rows.remove(0).fields;
        let named = |step: usize| -> Vec<String> {
            let plain = |name: &String| match step {
                3 => name.trim_end_matches(|c: char| "xyzXYZ_.".contains(c)).to_owned(),
                _ => name.clone(),
            };
            heading.iter().step_by(step).map(plain).collect()
        };
        points = if heading.len() == rows.len() { named(3) } else { named(1) };
    }
    if rows.is_empty() {
        return Err(Error::Empty { what: Lack::Points });
    }
    let expected = 3 * points.len();
    let triangle = rows.iter().enumerate().all(|(k, row)| row.fields.len() == k + 1);
    let full = rows.iter().all(|row| row.fields.len() == expected);
    if rows.len() != expected || !(triangle || full) {
        let wrong = rows.iter().find(|row| row.fields.len() != expected).unwrap_or(&rows[0]);
        let reason = Reason::EpochMatrix { rows: rows.len(), expected };
        return Err(Error::Invalid { reason, at: Place::line(wrong.line) });
    }
    let numbers =
        |row: &text::Row| (0..row.fields.len()).map(|k| row.number(k, "matrix")).collect::<Result<Vec<f64>>>();
    Ok(ListedCovariance { points, matrix: rows.iter().map(numbers).collect::<Result<_>>()? })
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn an_export_of_coordinates_is_read() {
        let text = "CODE1,-1353.223,2028.707,488.368,0.043,0.025,0.021,0.000\nCODE2,-265.741,2144.928,-1346.958,0.058,0.052,0.035,0.000\nTARGET7,1.5,2,3,0.1,0.2,0.3,0.000\n";
        let list = points(text, TableChoices::default()).unwrap();
        assert_eq!(list.points.len(), 3);
        assert_eq!((list.points[0].id.as_str(), list.points[0].xyz), ("CODE1", [-1353.223, 2028.707, 488.368]));
        assert_eq!(list.points[1].sigma, Some([0.058, 0.052, 0.035]));
        let bare = points("a 1 2 3\nb 4 5 6\n", TableChoices::default()).unwrap();
        assert!(bare.points.iter().all(|p| p.sigma.is_none()));
        let units = points("id;X [m];Y [m];Z [m]\na;1,5;2;3\nb;2,5;2;4\n", TableChoices::default()).unwrap();
        assert_eq!((units.unit.as_deref(), units.points[0].xyz[0]), (Some("m"), 1.5));
        assert_eq!(points("", TableChoices::default()), Err(Error::Empty { what: Lack::Points }));
    }

    #[test]
    fn a_matrix_is_read_in_full_or_as_a_triangle() {
        let names = ["a".to_owned(), "b".to_owned()];
        let value = |i: usize, j: usize| if i == j { 4.0 } else { 0.25 * (i + j) as f64 };
        let line = |i: usize, n: usize| (0..n).map(|j| value(i, j).to_string()).collect::<Vec<_>>().join(" ");
        let full: String = (0..6).map(|i| line(i, 6) + "\n").collect();
        let lower: String = (0..6).map(|i| line(i, i + 1) + "\n").collect();
        let read = covariance(&format!("# a b\n{full}"), &names).unwrap();
        assert_eq!((read.points, read.matrix[5][2]), (names.to_vec(), value(5, 2)));
        let read = covariance(&lower.replace(' ', ","), &names).unwrap();
        assert_eq!((read.matrix[5].len(), read.matrix[0].len(), read.matrix[5][2]), (6, 1, value(5, 2)));
        let headed = covariance(&format!("p q\n{full}"), &names).unwrap();
        assert_eq!(headed.points, ["p", "q"]);
        let headed = covariance(&format!("p_x p_y p_z q_x q_y q_z\n{full}"), &[]).unwrap();
        assert_eq!(headed.points, ["p", "q"]);
        for (text, names) in
            [(&full, &names[..1]), (&full.replacen("4", "four", 1), &names[..]), (&line(0, 6), &names[..])]
        {
            assert!(matches!(covariance(text, names), Err(Error::Invalid { .. })), "{text}");
        }
    }
}
