//! A project that names the northing first: every list that is written reads back as the same coordinates, with the user's letters in the user's
//! order, and nothing of it mirrors the object.

use std::collections::BTreeMap;

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::axes::{ShownAxes, UserAxes};
use sightline::noise::Noise;
use sightline::project::{Project, ReportLanguage, Role};
use sightline_exchange::control_csv::{SigmaRule, TableChoices};
use sightline_exchange::{Files, export, import_with, lists};

use crate::support::networks::{Uniform, Wanted, exact, noisy};

fn result(axes: Option<UserAxes>, seed: u64) -> (Project, Adjustment) {
    let mut project = noisy(&exact(&Wanted::default(), seed), &mut Noise::new(seed, 0));
    project.axes = axes;
    for (k, point) in project.points.iter_mut().enumerate().take(5) {
        point.role = if k == 4 { Role::Check } else { Role::Control };
        // Standard errors that no exchange leaves alone.
        point.sigma = Some([Some(0.1), Some(0.2), Some(0.3)]);
    }
    let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    (project, adjustment)
}

fn places(points: impl IntoIterator<Item = (String, [f64; 3])>) -> BTreeMap<String, [f64; 3]> {
    points.into_iter().collect()
}

/// Largest difference of two sets of points with the same names.
fn apart(a: &BTreeMap<String, [f64; 3]>, b: &BTreeMap<String, [f64; 3]>) -> f64 {
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    a.values().zip(b.values()).flat_map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs())).fold(0.0, f64::max)
}

#[test]
fn every_list_reads_back_as_the_same_coordinates() {
    for (seed, axes) in (1..).zip([None, Some(UserAxes::Enh), Some(UserAxes::Neh)]) {
        let (project, adjustment) = result(axes, seed);
        let adjusted = places(adjustment.points.iter().map(|p| (p.id.clone(), p.xyz)));
        let given = places(project.points.iter().filter_map(|p| Some((p.id.clone(), p.xyz?))));
        // Format, file, what it holds, how far its digits go.
        for (format, file, truth, digits) in [
            ("control-csv", "control.csv", &given, 0.0),
            ("csv", "points.csv", &adjusted, 0.0),
            ("tsv", "points.tsv", &adjusted, 0.0),
            ("spreadsheet", "points.csv", &adjusted, 0.1),
            ("spreadsheet-cp949", "points.csv", &adjusted, 0.1),
            ("landxml", "points.xml", &adjusted, 0.1),
        ] {
            let files = export(format, &project, Some(&adjustment)).expect(format);
            let list = lists::read(&files[file], &TableChoices::default()).expect(format);
            assert!(list.rejected.is_empty() && list.undecided.is_empty(), "{format} {axes:?}: {:?}", list.rejected);
            let found = places(list.points.iter().map(|row| (row.point.id.clone(), row.point.xyz.unwrap())));
            assert!(apart(truth, &found) <= digits, "{format} {axes:?}");
            let letters = ShownAxes::of(axes).names();
            if format != "landxml" {
                let heading = String::from_utf8_lossy(&files[file]).lines().next().unwrap().to_owned();
                let places = letters
                    .map(|letter| heading.split([',', '\t']).position(|name| name.split(' ').next() == Some(letter)));
                assert!(places.is_sorted() && places[0].is_some(), "{format} {heading}");
            }
            if format == "control-csv" {
                for row in list.points.iter().filter(|row| row.point.role != Role::Tie) {
                    assert_eq!(row.point.sigma, Some([Some(0.1), Some(0.2), Some(0.3)]), "{axes:?}");
                }
                let read = import_with(format, &files, TableChoices::default()).unwrap().project;
                assert_eq!(read.axes, axes);
            }
        }
    }
}

#[test]
fn standard_errors_and_differences_stand_under_their_letters() {
    let (project, adjustment) = result(Some(UserAxes::Neh), 7);
    let (plain, _) = result(None, 7);
    let table = |project: &Project, name: &str| {
        let files: Files = export("csv", project, Some(&adjustment)).unwrap();
        let text = String::from_utf8(files[name].clone()).unwrap();
        let mut rows = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
        rows.records().map(|row| row.unwrap().iter().map(str::to_owned).collect::<Vec<_>>()).collect::<Vec<_>>()
    };
    for name in ["points.csv", "photos.csv"] {
        let (own, xyz) = (table(&project, name), table(&plain, name));
        let column = |rows: &[Vec<String>], wanted: &str| -> Vec<String> {
            let at = rows[0].iter().position(|head| head.split(' ').next() == Some(wanted)).expect(wanted);
            rows.iter().skip(1).map(|row| row[at].clone()).collect()
        };
        for (letter, inside) in [("N", "Y"), ("E", "X"), ("H", "Z"), ("sN", "sY"), ("sE", "sX"), ("sH", "sZ")] {
            assert_eq!(column(&own, letter), column(&xyz, inside), "{name} {letter}");
        }
        assert!(!own[0].iter().any(|head| ["X", "Y", "Z", "sX"].contains(&head.split(' ').next().unwrap())));
    }
    // A drawing is not mirrored, and says what its axes are.
    let drawing =
        |project| String::from_utf8(export("dxf", project, Some(&adjustment)).unwrap()["drawing.dxf"].clone());
    let (own, xyz) = (drawing(&project).unwrap(), drawing(&plain).unwrap());
    assert!(own.lines().nth(1).unwrap().ends_with("X = E, Y = N, Z = H"));
    assert_eq!(own.lines().skip(2).collect::<Vec<_>>(), xyz.lines().skip(2).collect::<Vec<_>>());
}

#[test]
fn the_report_has_the_letters_of_the_user_in_both_languages() {
    let (mut project, adjustment) = result(Some(UserAxes::Neh), 5);
    for language in [ReportLanguage::English, ReportLanguage::Korean] {
        project.report.language = Some(language);
        let mut files = sightline_report::files::export("report", &project, Some(&adjustment), false).unwrap();
        let page = String::from_utf8(files.remove("report.html").unwrap()).unwrap();
        for head in ["<sub>N</sub>", "<sub>E</sub>", "<sub>H</sub>", "E →  N ↑", "N, E, H"] {
            assert!(page.contains(head), "{language:?} {head}");
        }
        for axis in ["X", "Y", "Z"] {
            let heads = [format!("<sub>{axis}</sub>"), format!(">{axis}<"), format!(">{axis} <"), format!(" {axis}<")];
            for head in heads.iter().chain([&"X, Y, Z".to_owned()]) {
                assert!(!page.contains(head.as_str()), "{language:?} {head}");
            }
        }
        let (north, east) = (page.find(">N <").unwrap(), page.find(">E <").unwrap());
        assert!(north < east);
    }
}

/// Typed points have the project's order of coordinates and no heading.
#[test]
fn rows_without_a_heading_stand_as_the_project_does() {
    let mut random = Uniform(52);
    for _ in 0..40 {
        let xyz = [0; 3].map(|_| (random.between(-1e5, 1e5) * 1000.0).round() / 1000.0);
        for axes in [UserAxes::Enh, UserAxes::Neh] {
            let [a, b, c] = ShownAxes::of(Some(axes)).shown(xyz);
            let text = format!("p\t{a:.3}\t{b:.3}\t{c:.3}\nq\t{b:.3}\t{a:.3}\t{c:.3}\n");
            let choices = TableChoices {
                project_axes: Some(axes),
                sigma: Some(SigmaRule::read("2 mm").unwrap()),
                unit: sightline::units::Unit::named("m"),
                ..TableChoices::default()
            };
            let list = lists::read(text.as_bytes(), &choices).unwrap();
            assert!(list.undecided.is_empty() && list.rejected.is_empty());
            assert_eq!(list.points[0].point.xyz, Some(xyz), "{text}");
        }
    }
}
