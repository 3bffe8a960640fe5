//! Every format that is both written and read reads back what it writes, whatever the identifiers are, or refuses them by name.

use sightline::error::Error;
use sightline::project::{Camera, Interior, Observation, Photo, Point, Project, Role, Sigma};
use sightline_exchange::{export, import};

use crate::support::painter::Uniform;

/// Characters of identifiers in difficult files.
const LETTERS: [char; 24] = [
    'a', 'B', '7', '0', '가', 'é', ',', ';', '"', '\'', '\n', '\r', '\t', '=', '+', '-', '@', '#', '%', ' ', '.', '\\',
    '/', '{',
];

fn identifier(random: &mut Uniform) -> String {
    let length = (6.0 * random.next().powi(2)) as usize + usize::from(random.next() > 0.02);
    // half of them are harmless
    let among = if random.next() < 0.5 { 6 } else { LETTERS.len() };
    (0..length).map(|_| LETTERS[(among as f64 * random.next()) as usize]).collect()
}

fn number(random: &mut Uniform) -> f64 {
    let scale = 10f64.powi((12.0 * random.next()) as i32 - 4);
    (random.next() - 0.5) * scale
}

fn project(random: &mut Uniform) -> Project {
    let points = (0..1 + (4.0 * random.next()) as usize).map(|_| Point {
        id: identifier(random),
        role: [Role::Tie, Role::Control, Role::Check][(3.0 * random.next()) as usize],
        xyz: Some([number(random), number(random), number(random)]),
        sigma: (random.next() < 0.5).then(|| [Some(number(random).abs()), None, Some(number(random).abs())]),
        diameter: None,
        normal: None,
    });
    let mut points = points.collect::<Vec<_>>();
    points.sort_by(|a, b| a.id.cmp(&b.id));
    points.dedup_by(|a, b| a.id == b.id);
    let photo =
        Photo { id: identifier(random), camera: "c".into(), file: "1.jpg".into(), enabled: true, ..Photo::default() };
    let observations = points.iter().map(|point| Observation {
        photo: photo.id.clone(),
        point: point.id.clone(),
        u: number(random),
        v: number(random),
        sigma: Sigma::Two([number(random).abs() + 1e-9, number(random).abs() + 1e-9]),
        enabled: true,
        target: None,
    });
    Project {
        observations: observations.collect(),
        cameras: vec![Camera::new("c", 100, 80, Interior::brown(12.5))],
        photos: vec![photo].into(),
        points: points.into(),
        ..Project::default()
    }
}

/// Whether an error is a refusal that names one of the identifiers.
fn names(error: &Error, project: &Project) -> bool {
    let at = error.place();
    let point = at.point.is_some_and(|id| project.points.iter().any(|point| point.id == id));
    error.code() == "invalid" && (point || at.photo.is_some_and(|id| project.photos[0].id == id))
}

#[test]
fn what_is_written_is_read_again() {
    let mut random = Uniform(41);
    let (mut control, mut marks) = ([0; 2], [0; 2]);
    for _ in 0..1500 {
        let project = project(&mut random);
        for format in ["sightline", "package"] {
            let files = export(format, &project, None).expect("carries everything");
            assert_eq!(import(format, &files).expect("our own"), project, "{format}");
        }
        match export("control-csv", &project, None) {
            Ok(files) => {
                assert_eq!(import("control-csv", &files).expect("our own").points, project.points);
                control[0] += 1;
            }
            Err(error) => {
                assert!(names(&error, &project), "{error}");
                control[1] += 1;
            }
        }
        match export("mark-points", &project, None) {
            Ok(files) => {
                assert_eq!(import("mark-points", &files).expect("our own").observations, project.observations);
                marks[0] += 1;
            }
            Err(error) => {
                assert!(names(&error, &project), "{error}");
                marks[1] += 1;
            }
        }
    }
    // both happen often enough to be tested
    assert!(control.iter().chain(&marks).all(|count| *count > 100), "{control:?} {marks:?}");
}

#[test]
fn no_cell_of_an_export_begins_like_a_formula() {
    let mut random = Uniform(43);
    for _ in 0..300 {
        let project = project(&mut random);
        for format in ["csv", "tsv", "control-csv"] {
            let Ok(files) = export(format, &project, None) else { continue };
            for (name, bytes) in files {
                let separator = if name.ends_with("tsv") { b'\t' } else { b',' };
                let mut reader =
                    csv::ReaderBuilder::new().delimiter(separator).has_headers(false).from_reader(&bytes[..]);
                for record in reader.records().map(|record| record.expect("a row")) {
                    for cell in &record {
                        let armed = cell.starts_with(['=', '+', '-', '@', '\t', '\r']) && cell.parse::<f64>().is_err();
                        assert!(!armed, "{name}: {cell:?}");
                    }
                }
            }
        }
    }
}
