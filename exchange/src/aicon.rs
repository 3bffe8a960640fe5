//! Lists of target coordinates as AICON's software writes them: id, X, Y, Z, then a sigma (or "fix") per axis and
//! further columns, separated by blanks, in millimetres.

use super::text;
use sightline::error::{Error, Lack, Place, Result, Thing};
use sightline::project::{Point, Role};

/// Reads the list as control points; "fix" means an axis without sigma.
///
/// # Errors
/// [`Error::Invalid`] with line and field, [`Error::Duplicate`], [`Error::Empty`].
pub fn parse(text: &str) -> Result<Vec<Point>> {
    let mut points: Vec<Point> = Vec::new();
    let mut seen = std::collections::HashSet::new();
    for row in text::rows(text) {
        let id = row.text(0, "id")?.to_owned();
        if !seen.insert(id.clone()) {
            return Err(Error::Duplicate { kind: Thing::Point, name: id, at: Place::line(row.line) });
        }
        let xyz = [row.number(1, "x")?, row.number(2, "y")?, row.number(3, "z")?];
        let mut sigma = [None; 3];
        for (axis, name) in ["sx", "sy", "sz"].into_iter().enumerate() {
            if row.fields.get(4 + axis).is_some_and(|field| !field.eq_ignore_ascii_case("fix")) {
                sigma[axis] = Some(row.number(4 + axis, name)?);
            }
        }
        let sigma = sigma.iter().any(Option::is_some).then_some(sigma);
        points.push(Point { id, role: Role::Control, xyz: Some(xyz), sigma, diameter: None, normal: None });
    }
    if points.is_empty() { Err(Error::Empty { what: Lack::Points }) } else { Ok(points) }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn fixed_and_weighted_axes_are_told_apart() {
        let points = parse("  2  -0.2000  -0.1216  -0.3116  fix fix fix  99 0\n 3 1 2 3 0.01 fix 0.02 5 0\n").unwrap();
        assert_eq!(points[0].xyz, Some([-0.2, -0.1216, -0.3116]));
        assert_eq!(points[0].sigma, None);
        assert_eq!(points[1].sigma, Some([Some(0.01), None, Some(0.02)]));
        assert_eq!(parse("2 1 2 3\n2 1 2 3").unwrap_err().place(), Place::line(2));
        assert_eq!(parse("2 1 zwei 3").unwrap_err().place(), Place::line(1).with_field("y"));
    }
}
