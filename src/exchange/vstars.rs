//! Points of V-STARS: a record has a label, X, Y, Z and, where they are known, three standard errors.
//!
//! Fields are separated by blanks, commas or semicolons, parentheses around coordinates are passed over:
//! `POINT1 (12.5122, -2.2231, 3.4456); 0.0012, 0.0010, 0.0018`. The object system is right-handed; the unit is not in the file.
//!
//! Source: a description of V-STARS' XYZ files by its users ("What is XYZ File in aerial photogrammetry?"), whose records these are. Columns after the standard errors (offsets, rays, descriptions) are counted.

use std::collections::{HashMap, HashSet};
use std::fmt::Write;

use super::foreign::Notes;
use super::text::Row;
use crate::adjustment::Adjustment;
use crate::error::{Error, Lack, Place, Reason, Result, Thing, shortened};
use crate::project::{Point, Project, Role};

/// Reads points as control points.
///
/// # Errors
/// [`Error::Invalid`] with line and field, [`Error::Duplicate`], [`Error::Empty`].
pub fn read(text: &str, notes: &mut Notes) -> Result<Vec<Point>> {
    let mut points = Vec::new();
    let mut seen = HashSet::new();
    for (k, line) in text.lines().enumerate() {
        let row = fields(k + 1, line);
        // A heading has words where numbers are expected; so has damage, but not before all points.
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
                    return Err(row.invalid(name, Reason::Negative { name: name.into(), value: value.into() }));
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

/// Fields of a line. Where semicolons separate all of them, commas are none: "1,5" is refused as a number then, not taken apart.
fn fields(line: usize, text: &str) -> Row {
    let semicolons = text.matches(';').count() >= 3;
    let separates = |c: char| matches!(c, ';' | '(' | ')' | '\t') || c == ' ' || (c == ',' && !semicolons);
    let fields = text.split(separates).map(|field| field.trim().trim_matches('"')).filter(|field| !field.is_empty());
    Row { line, fields: fields.map(str::to_owned).collect() }
}

/// `points.csv`: label, X, Y, Z and standard errors, adjusted where there is an adjustment.
///
/// # Errors
/// [`Reason::CannotCarry`] for a label that would be read as more than one field.
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
            // What a spreadsheet would run as a formula would have to be changed.
            && super::disarmed(&point.id) == point.id.as_str();
        if !plain {
            let reason = Reason::CannotCarry { name: shortened(&point.id) };
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
