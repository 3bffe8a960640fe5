//! Point files of V-STARS: a record has a label, X, Y, Z and, optionally, three standard errors.
//!
//! Fields are separated by blanks, commas or semicolons; parentheses around coordinates are ignored:
//! `POINT1 (12.5122, -2.2231, 3.4456); 0.0012, 0.0010, 0.0018`. The object system is right-handed; the unit is not in the file.
//!
//! Source of the format and of the example: a description by users ("What is XYZ File in aerial photogrammetry?"). Columns after the
//! standard errors (offsets, rays, descriptions) are not read; their number is reported in the notes.

use crate::reason::ExchangeReason;
use std::collections::{HashMap, HashSet};
use std::fmt::Write;

use super::foreign::Notes;
use super::text::Row;
use sightline::adjustment::Adjustment;
use sightline::error::{Error, Lack, Place, Result, Thing, shortened};
use sightline::project::{Point, Project, Role};

/// Reads points as control points.
///
/// # Errors
/// [`Error::Invalid`] with line and field, [`Error::Duplicate`], [`Error::Empty`].
pub fn read(text: &str, notes: &mut Notes) -> Result<Vec<Point>> {
    let mut points = Vec::new();
    let mut seen = HashSet::new();
    for (k, line) in text.lines().enumerate() {
        let row = fields(k + 1, line);
        // A heading has words where numbers are expected. After the first point such a row is damaged, not a heading.
        let words = |field: &String| field.starts_with(|c: char| c.is_alphabetic() || c == '[');
        let heading = points.is_empty() && row.fields.len() >= 4 && row.fields[1..4].iter().all(words);
        if row.fields.is_empty() || line.trim_start().starts_with(['#', '%', '/']) || heading {
            continue;
        }
        let id = row.text(0, "label")?.to_owned();
        if !seen.insert(id.clone()) {
            return Err(Error::Duplicate { kind: Thing::Point, name: id, at: Place::line(row.line) });
        }
        let xyz = [row.number(1, "X")?, row.number(2, "Y")?, row.number(3, "Z")?];
        let sigma = if row.fields.len() >= 7 {
            let mut sigma = [None; 3];
            for (axis, name) in ["sX", "sY", "sZ"].into_iter().enumerate() {
                let value = row.number(4 + axis, name)?;
                if value < 0.0 {
                    return Err(
                        row.invalid(name, ExchangeReason::Negative { name: name.into(), value: value.into() }.into())
                    );
                }
                sigma[axis] = Some(value);
            }
            Some(sigma)
        } else {
            None
        };
        notes.ignore("further columns", row.fields.len().saturating_sub(if sigma.is_some() { 7 } else { 4 }));
        points.push(Point { id, role: Role::Control, xyz: Some(xyz), sigma, ..Point::default() });
    }
    if points.is_empty() { Err(Error::Empty { what: Lack::Points }) } else { Ok(points) }
}

/// Fields of a line. If semicolons separate the fields, commas do not: "1,5" is then refused as a number instead of being split.
fn fields(line: usize, text: &str) -> Row {
    let semicolons = text.matches(';').count() >= 3;
    let separates = |c: char| matches!(c, ';' | '(' | ')' | '\t') || c == ' ' || (c == ',' && !semicolons);
    let fields = text.split(separates).map(|field| field.trim().trim_matches('"')).filter(|field| !field.is_empty());
    Row { line, fields: fields.map(str::to_owned).collect() }
}

/// `points.csv`: label, X, Y, Z and standard errors; adjusted values if there is an adjustment, else the given ones.
///
/// # Errors
/// [`ExchangeReason::CannotCarry`] for a label that would be read as more than one field.
pub fn write(project: &Project, adjustment: Option<&Adjustment>) -> Result<String> {
    let adjusted: HashMap<&str, _> = adjustment
        .into_iter()
        .flat_map(|adjustment| &adjustment.points)
        .map(|point| (point.id.as_str(), (point.xyz, point.sigma)))
        .collect();
    let mut text = String::new();
    for point in &project.points {
        let given = point.xyz.map(|xyz| (xyz, point.sigma.and_then(|[x, y, z]| Some([x?, y?, z?]))));
        let Some((xyz, sigma)) = adjusted.get(point.id.as_str()).copied().or(given) else { continue };
        let row = fields(1, &point.id);
        let plain = row.fields.len() == 1
            && row.fields[0] == point.id
            && !point.id.starts_with(['#', '%', '/'])
            // A label that a spreadsheet would execute as a formula would have to be changed.
            && super::disarmed(&point.id) == point.id.as_str();
        if !plain {
            let reason = ExchangeReason::CannotCarry { name: shortened(&point.id) }.into();
            return Err(Error::Invalid { reason, at: Place::point(&point.id) });
        }
        let [x, y, z] = xyz;
        let _ = write!(text, "{},{x:?},{y:?},{z:?}", point.id);
        if let Some([sx, sy, sz]) = sigma {
            let _ = write!(text, ",{sx:?},{sy:?},{sz:?}");
        }
        text.push('\n');
    }
    Ok(text)
}
