//! Trimble JobXML: points by name with north, east, elevation, in metres whatever the display shows.
//!
//! `Reductions/Point/Grid` holds one final position for each name. A file without reductions has its positions at `FieldBook/PointRecord/Grid` or
//! `ComputedGrid`; those that are marked as deleted are counted. Points with a position on the ellipsoid only are counted too.
//!
//! Source: Trimble Geospatial, "JobXML format", schema 5.x.

use super::{Beside, Listed, point, tag_lines};
use crate::dbat::element::{Element, parse};
use sightline::error::Result;
use sightline::units::Unit;

/// Whether the document's element is a job.
pub(super) fn recognises(text: &str) -> bool {
    text.trim_start().starts_with('<') && !tag_lines(text.get(..4096).unwrap_or(text), "JOBFile").is_empty()
}

/// Reads the points.
pub(super) fn read(text: &str) -> Result<Listed> {
    let root = parse(text)?;
    let reduced = root.child("Reductions").filter(|reductions| reductions.child("Point").is_some());
    let (points, name): (Vec<&Element>, _) = match reduced {
        Some(reductions) => (reductions.children("Point").collect(), "Point"),
        None => {
            let books = root.children("FieldBook");
            (books.flat_map(|book| book.children("PointRecord")).collect(), "PointRecord")
        }
    };
    let lines = tag_lines(text, name);
    let mut listed = Listed { unit: Some(Unit::Metre), repeats: true, ..Listed::default() };
    let (mut deleted, mut elsewhere) = (0, 0);
    for (k, record) in points.iter().enumerate() {
        let word = |name: &str| record.child(name).map_or("", |child| child.text.as_str());
        if word("Deleted") == "true" {
            deleted += 1;
            continue;
        }
        let Some(grid) = record.child("Grid").or(record.child("ComputedGrid")) else {
            elsewhere += 1;
            continue;
        };
        let place = |name: &str| grid.child(name).map_or("", |child| child.text.as_str());
        let line = if lines.len() == points.len() { lines[k] } else { k + 1 };
        let words = [place("East"), place("North"), place("Elevation")];
        listed.rows.push(point(line, word("Name"), word("Code"), words, 1.0));
    }
    listed.beside = vec![(Beside::Deleted, deleted), (Beside::Geographic, elsewhere)];
    Ok(listed)
}
