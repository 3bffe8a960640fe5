//! Files with the contents and the scale of a print.

use std::fmt::Write;

use super::{RULER_MM, Sheets};
use sightline::axes::ShownAxes;
use sightline::project::{Point, Role};
use sightline_exchange::control_csv;

/// Standard error of a dot's place in its sheet, mm: what printers keep over a sheet.
const IN_SHEET_MM: f64 = 0.1;
/// Standard error of a dot's place on a plate of several sheets, mm: what mounting by hand keeps.
const ON_PLATE_MM: f64 = 0.5;

/// Diameters, distances and coordinates, as far as there are any.
pub fn files(sheets: &Sheets) -> Vec<(String, Vec<u8>)> {
    let mut files = vec![("targets.csv".to_owned(), targets(sheets).into_bytes())];
    if !sheets.bars.is_empty() {
        files.push(("distances.csv".to_owned(), distances(sheets).into_bytes()));
    }
    let field: Vec<Point> = field(sheets);
    if !field.is_empty() {
        files.push(("control.csv".to_owned(), control_csv::write(&field, ShownAxes::XYZ).into_bytes()));
    }
    files
}

/// Every target with its diameter on paper.
fn targets(sheets: &Sheets) -> String {
    let mut text = format!(
        "# scale of the print across {:.5}, down {:.5}, standard error {:.5}: the ruler of {RULER_MM} mm\n\
         id,kind,sheet,diameter,sigma\n",
        sheets.scale[0], sheets.scale[1], sheets.scale_sigma
    );
    let (diameter, sigma) = (sheets.diameter, sheets.diameter * sheets.scale_sigma);
    for target in &sheets.targets {
        let kind = match target.kind {
            super::TargetKind::Code => "code",
            super::TargetKind::Dot => "dot",
            super::TargetKind::BarEnd => "bar end",
        };
        // Writing to a string does not fail.
        let _ = writeln!(text, "{},{kind},{},{diameter:.4},{sigma:.4}", target.id, target.sheet);
    }
    text
}

/// Scale bars as from, to, length, standard error; the last is empty if the distance is still to be measured.
fn distances(sheets: &Sheets) -> String {
    let mut text = String::from("from,to,length,sigma\n");
    for bar in &sheets.bars {
        let sigma = bar.sigma.map(|s| format!("{s:.4}")).unwrap_or_default();
        let _ = writeln!(text, "{},{},{:.4},{sigma}", bar.from, bar.to, bar.length);
    }
    text
}

/// The calibration field as control points, with the diameter of their dots.
fn field(sheets: &Sheets) -> Vec<Point> {
    let last = |f: fn(&super::Printed) -> bool| sheets.targets.iter().filter(|t| f(t)).map(|t| t.sheet).max();
    let first = sheets.targets.iter().filter(|t| t.plate.is_some()).map(|t| t.sheet).min();
    let several = last(|t| t.plate.is_some()) != first;
    let sigma = if several { ON_PLATE_MM } else { IN_SHEET_MM };
    let rounded = |value: f64| (value * 1e4).round() / 1e4;
    let point = |target: &super::Printed| {
        let [x, y] = target.plate?;
        Some(Point {
            id: target.id.clone(),
            role: Role::Control,
            xyz: Some([rounded(x), rounded(y), 0.0]),
            sigma: Some([Some(sigma); 3]),
            diameter: Some(rounded(sheets.diameter)),
            ..Point::default()
        })
    };
    sheets.targets.iter().filter_map(point).collect()
}
