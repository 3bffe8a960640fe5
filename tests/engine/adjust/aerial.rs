//! The aerial block of DBAT (Strasbourg, five photos, control in large coordinates): its published runs, repeated.

use crate::support::data;
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, ResidualPlace};
use sightline::orient::orient;
use sightline::project::{DatumKind, Project, Role, Sigma};
use sightline_exchange::{self as exchange, photomodeler};

/// Origin to which the local coordinates of the exports are reduced.
const OFFSET: [f64; 3] = [999_779.506_31, 112_260.591, 139.832_1];

fn solve(project: &Project) -> Adjustment {
    let options = AdjustOptions { residuals: ResidualPlace::Corrected, ..AdjustOptions::default() };
    let adjustment = adjust(project, &options, &mut |_| true).expect("solvable");
    super::published::nothing_is_asked(&adjustment);
    adjustment
}

/// An export with its control replaced by a list, everything in the list's own coordinates.
fn block(export: &str, control: &str) -> Option<Project> {
    let mut project = photomodeler::parse(&data::text(&format!("sxb/{export}"))?).expect("a valid export");
    let outside = |local: [f64; 3]| std::array::from_fn(|a| local[a] + OFFSET[a]);
    project.cameras.truncate(1);
    project.cameras[0].free.clear();
    let id = project.cameras[0].id.clone();
    for photo in &mut project.photos {
        photo.camera.clone_from(&id);
        photo.position = photo.position.map(outside);
    }
    for point in &mut project.points {
        (point.xyz, point.sigma) = (point.xyz.map(outside), None);
    }
    for line in data::text(&format!("sxb/{control}"))?.lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        let number = |k: usize| fields.get(k).and_then(|field| field.parse::<f64>().ok());
        let point = project.points.iter_mut().find(|p| p.id == fields[0]).expect("a measured point");
        point.role = Role::Control;
        point.xyz = Some([2, 3, 4].map(|k| number(k).expect("a coordinate")));
        point.sigma = number(5).map(|_| [number(5), number(6), number(7)]);
    }
    project.observations.iter_mut().for_each(|o| o.sigma = Sigma::One(1.0));
    project.datum.kind = DatumKind::Control;
    Some(project)
}

/// Value and deviation of omega, phi, kappa (degrees), Xc, Yc, Zc of every photo of a report.
fn published(report: &str) -> Vec<[(f64, f64); 6]> {
    let number = |line: &str| line.split_whitespace().nth(1).and_then(|n| n.parse::<f64>().ok()).expect("a number");
    let mut photos: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut lines = report.lines().map(str::trim).peekable();
    while let Some(line) = lines.next() {
        if line.starts_with("Photo ") && line.contains(".jpg") {
            photos.push(Vec::new());
        }
        let named = ["Omega:", "Phi:", "Kappa:", "Xc:", "Yc:", "Zc:"].contains(&line);
        if let (true, Some(photo)) = (named, photos.last_mut().filter(|photo| photo.len() < 6)) {
            let value = number(lines.next().expect("a value"));
            photo.push((value, number(lines.next().expect("a deviation"))));
        }
    }
    photos.into_iter().filter_map(|photo| photo.try_into().ok()).collect()
}

fn agrees_with(name: &str, project: &Project, sigma0: f64, redundancy: usize) {
    let adjustment = solve(project);
    assert_eq!(adjustment.redundancy, redundancy, "{name}");
    let got = adjustment.sigma0.expect("redundant");
    assert!((got - sigma0).abs() <= 0.5e-6_f64.max(sigma0 * 5e-7), "{name}: sigma0 {got}");
    let report = data::text(&format!("sxb/reports/{name}-with-orient-dbatreport.txt")).expect("beside the export");
    let published = published(&report);
    assert_eq!(published.len(), adjustment.photos.len(), "{name}");
    for (photo, published) in adjustment.photos.iter().zip(published) {
        let (angles, sigmas) = (photo.rotation, photo.sigma_rotation.expect("determined"));
        let places = photo.sigma_position.expect("determined");
        for (k, (value, deviation)) in published.into_iter().enumerate() {
            let (got, sigma) = match k {
                0..3 => (angles[k].to_degrees(), sigmas[k].to_degrees()),
                _ => (photo.position[k - 3] - OFFSET[k - 3], places[k - 3]),
            };
            assert!((got - value).abs() <= 0.05 * deviation, "{name} {} {k}: {got} is not {value}", photo.id);
            assert!((sigma / deviation - 1.0).abs() <= 0.01, "{name} {} {k}: sigma {sigma}, {deviation}", photo.id);
        }
    }
}

#[test]
fn fixed_control_has_the_published_answer() {
    let Some(project) = block("f-op0-with-orient-pmexport.txt", "ctrlpts-fixed.txt") else { return };
    let adjustment = solve(&project);
    // Printed with four decimals.
    assert!((adjustment.sigma0.expect("redundant") - 1.0419).abs() <= 0.5e-4, "{:?}", adjustment.sigma0);
    agrees_with("f-op0", &project, adjustment.sigma0.expect("redundant"), 64);
}

#[test]
fn weighted_control_has_the_published_answer() {
    let Some(project) = block("w-op0-with-orient-pmexport.txt", "ctrlpts-weighted.txt") else { return };
    agrees_with("w-op0", &project, 0.984904, 64);
    let project = block("w-op1-with-orient-pmexport.txt", "ctrlpts-weighted.txt").expect("beside the other");
    agrees_with("w-op1", &project, 0.965375, 69);
}

#[test]
fn the_block_with_its_tie_points_has_the_published_answer() {
    let paths = [
        "sxb/sxb.xml",
        "sxb/reference/sxb-control.txt",
        "sxb/images/images.txt",
        "sxb/measurements/markpts.txt",
        "sxb/measurements/smartpts.txt",
    ];
    let mut files = exchange::Files::new();
    for path in paths {
        let Some(bytes) = data::data(path) else { return };
        files.insert(path.into(), bytes);
    }
    let project = exchange::import("dbat", &files).expect("a valid project");
    let adjustment = solve(&orient(&project).expect("orientable").project);
    assert_eq!(adjustment.redundancy, 1261);
    let sigma0 = adjustment.sigma0.expect("redundant");
    assert!((sigma0 - 1.1786).abs() <= 0.5e-4, "{sigma0}");
}
