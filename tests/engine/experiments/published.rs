//! The papers' figures.

use sightline_lab::experiments::{Cell, Experiment, ExperimentOptions, NAMES, run};

fn result(name: &str) -> Experiment {
    run(name, &ExperimentOptions::default(), &mut |_, _| true).expect(name)
}

fn figure(result: &Experiment, id: &str) -> f64 {
    result.figures.iter().find(|f| f.id == id).unwrap_or_else(|| panic!("no figure {id}")).ours
}

/// Every table is rectangular, every number finite, and the project can be adjusted as it stands.
fn well_formed(result: &Experiment) {
    assert!(!result.drawings.is_empty() && !result.charts.is_empty() && !result.tables.is_empty());
    for table in &result.tables {
        assert!(!table.rows.is_empty(), "{} is empty", table.id);
        assert!(table.rows.iter().all(|row| row.len() == table.columns.len()), "{} is ragged", table.id);
    }
    assert!(result.figures.iter().all(|f| f.ours.is_finite()), "{:?}", result.figures);
    assert!(result.charts.iter().flat_map(|c| &c.series).flat_map(|s| &s.points).flatten().all(|x| x.is_finite()));
    result.project.validate().unwrap();
    let adjustment = sightline::adjust::adjust(&result.project, &Default::default(), &mut |_| true).unwrap();
    assert_eq!(adjustment.termination, sightline::adjustment::Termination::Converged);
}

#[test]
fn kang_and_yeu() {
    let kang = result("kang");
    well_formed(&kang);
    let mut with_independent = 0;
    for f in &kang.figures {
        if let Some(independent) = f.independent {
            assert!((f.ours - independent).abs() <= 0.5, "{f:?}");
            with_independent += 1;
        }
        if f.id.starts_with("observations") || f.id.starts_with("unknowns") {
            assert_eq!(Some(f.ours), f.paper, "{f:?}");
        } else if let Some(paper) = f.paper {
            assert!((f.ours - paper).abs() <= 4.0, "{f:?}");
        }
        if f.id.starts_with("monte_carlo") {
            assert!(f.ours.abs() <= 3.0, "{f:?}");
        }
    }
    assert_eq!(with_independent, 8);
    let rows = |id: &str| kang.tables.iter().find(|t| t.id == id).map(|t| t.rows.len());
    assert_eq!((rows("single"), rows("mixed"), rows("pairwise")), (Some(60), Some(16), Some(15)));
    // Draws of their own: S0 of the networks of two photos scatters about 1 by its standard error, and their mean is that of no single draw.
    let single = kang.tables.iter().find(|t| t.id == "single").expect("a table");
    let column = |id: &str| single.columns.iter().position(|c| c.id == id).expect("a column");
    let number = |row: &[Cell], id: &str| match row[column(id)] {
        Cell::Number(value) => value,
        ref other => panic!("{id}: {other:?}"),
    };
    let two = single.rows.iter().filter(|row| number(row, "m") == 60.0);
    let all: Vec<[f64; 2]> = two.map(|row| [number(row, "s0"), number(row, "s0_sigma")]).collect();
    let mean = all.iter().map(|[s0, _]| s0).sum::<f64>() / all.len() as f64;
    let chi = (all.iter().map(|[s0, sigma]| ((s0 - 1.0) / sigma).powi(2)).sum::<f64>() / all.len() as f64).sqrt();
    assert!(all.len() == 15 && (mean - 1.0).abs() < 0.1 && (0.5..1.6).contains(&chi), "{mean} {chi} {all:?}");
}

#[test]
fn film() {
    let film = result("film");
    well_formed(&film);
    // The film shrinks differently along and across: a similarity cannot follow, an affine transformation can.
    assert!(figure(&film, "marks_sigma0/similarity") > 3.0 * figure(&film, "marks_sigma0/affine"));
    // Marks are read to 1.5 µm.
    assert!((figure(&film, "marks_sigma0/affine") / 1.5 - 1.0).abs() < 0.25);
    // With the lens corrected, the bundle's residuals are what the readings' 3 µm make them (5 % of 75 redundant).
    let corrected = figure(&film, "sigma0/affine-corrected");
    assert!((corrected - 1.0).abs() < 0.16 && corrected < figure(&film, "sigma0/affine"), "{corrected}");
    assert!(figure(&film, "distortion_sigma0") < 0.3);
}

/// The experiment's own description and readings, read as files, are its project.
#[test]
fn film_as_files() {
    let film = result("film");
    let csv = sightline_lab::experiments::csv(&film);
    let files = [
        ("camera.txt".to_owned(), sightline_lab::experiments::film_description().into_bytes()),
        ("readings.csv".to_owned(), csv["film-readings.csv"].clone()),
    ];
    let reduced = sightline_exchange::comparator::import(&files.into_iter().collect()).unwrap();
    assert_eq!(reduced.inner_orientations.len(), 5);
    assert_eq!(reduced.project.observations.len(), film.project.observations.len());
    for (a, b) in reduced.project.observations.iter().zip(&film.project.observations) {
        assert_eq!((&a.photo, &a.point), (&b.photo, &b.point));
        assert!((a.u - b.u).abs() < 1e-8 && (a.v - b.v).abs() < 1e-8, "{a:?} {b:?}");
    }
    // From readings alone to coordinates: the same as from the true initial values, with the same draw of the control.
    let mut project = reduced.project;
    for point in project.points.iter_mut().filter(|p| p.xyz.is_some()) {
        point.xyz = film.project.points.iter().find(|p| p.id == point.id).expect("the point").xyz;
    }
    let oriented = sightline::orient::orient(&project).unwrap().project;
    let adjust = |p| sightline::adjust::adjust(p, &Default::default(), &mut |_| true).unwrap();
    let (ours, known) = (adjust(&oriented), adjust(&film.project));
    for point in &known.points {
        let found = ours.points.iter().find(|p| p.id == point.id).expect("the point");
        assert!((0..3).all(|k| (found.xyz[k] - point.xyz[k]).abs() < 1e-4), "{point:?} {found:?}");
    }
}

#[test]
fn lee_structure() {
    let lee = result("lee-structure");
    well_formed(&lee);
    // Table 5 prints 17.2 %, which tables 3 and 4 contradict.
    let gain = lee.figures.iter().find(|f| f.id == "gain_z/I").and_then(|f| f.paper).expect("a figure");
    assert!((gain - 26.9).abs() < 0.06, "{gain}");
    let misprint = lee.assumptions.iter().find(|a| a.id == "gain_misprint").expect("an assumption");
    assert_eq!((misprint.ours, misprint.paper), (Some(gain), Some(17.2)));
    for datum in ["control", "free"] {
        let depth = |network: &str| figure(&lee, &format!("sy/{network}-{datum}"));
        assert!(depth("III") < depth("I") && depth("I") < depth("II"), "{datum}");
    }
    for network in ["I", "II", "III"] {
        for axis in ["x", "y", "z"] {
            assert!(figure(&lee, &format!("gain_{axis}/{network}")) > 0.0, "{axis} {network}");
        }
    }
}

#[test]
fn lee_calibration() {
    let lee = result("lee-calibration");
    well_formed(&lee);
    assert!(figure(&lee, "relative/all") >= 46_400.0 && figure(&lee, "relative/reduced") >= 46_400.0);
    for label in ["all", "reduced"] {
        for parameter in ["c", "x0", "y0", "k1", "k2", "k3", "p1", "p2"] {
            let error = figure(&lee, &format!("error_{parameter}/{label}"));
            assert!(error.abs() <= 2.5, "{parameter} off by {error} sigma ({label})");
        }
    }
    assert!(figure(&lee, "residual_px_x/reduced") <= 0.037 && figure(&lee, "residual_px_y/reduced") <= 0.031);
    // The estimators, best first, and the best is no centroid.
    let estimators = lee.tables.iter().find(|t| t.id == "estimators").expect("estimators");
    assert_eq!(estimators.rows.len(), 4);
    assert!(figure(&lee, "centre_rms/least_squares") <= figure(&lee, "centre_rms/intensity"));
}

#[test]
fn kim() {
    let kim = result("kim");
    well_formed(&kim);
    assert_eq!(figure(&kim, "check_points"), 15.0);
    assert!(figure(&kim, "iterations") <= 6.0);
    for axis in ["x", "y", "z"] {
        let rms = kim.figures.iter().find(|f| f.id == format!("rms/{axis}")).expect("rms");
        assert!(rms.ours < rms.paper.expect("the paper's"), "{rms:?}");
    }
}

#[test]
fn names_options_and_stopping() {
    let unknown = run("nobody", &ExperimentOptions::default(), &mut |_, _| true).expect_err("unknown");
    assert_eq!(unknown.code(), "unknown");
    let wrong = ExperimentOptions { image_sigma_um: Some(f64::NAN), ..ExperimentOptions::default() };
    assert_eq!(run("kang", &wrong, &mut |_, _| true).expect_err("sigma").code(), "invalid");
    for name in NAMES {
        let stopped = run(name, &ExperimentOptions::default(), &mut |_, _| false).expect_err("stopped");
        assert_eq!(stopped.code(), "cancelled", "{name}");
    }
    let nowhere = ExperimentOptions { network: Some("9.9-2A".into()), rounds: Some(0), ..ExperimentOptions::default() };
    assert_eq!(run("kang", &nowhere, &mut |_, _| true).expect_err("network").code(), "unknown");
}

/// Every step from the sensor's samples to a JPEG is measured, all that is in sight, with standard errors that are not too small; what the camera
/// does after demosaicing costs coordinates. (A colourless scene tells red and blue sites as much as green ones: demosaiced linearly, it has
/// twice the samples.)
#[test]
#[ignore = "a quarter of a minute; the page's tests run this experiment too"]
fn sensor() {
    let sensor = result("sensor");
    well_formed(&sensor);
    let [table] = sensor.tables.as_slice() else { panic!("one table") };
    assert_eq!(table.rows.len(), 6);
    let number = |row: usize, id: &str| {
        let column = table.columns.iter().position(|c| c.id == id).unwrap_or_else(|| panic!("no column {id}"));
        match table.rows[row][column] {
            Cell::Number(value) => value,
            ref other => panic!("{id}: {other:?}"),
        }
    };
    let visible = figure(&sensor, "visible");
    for row in 0..6 {
        println!("{:?}", table.rows[row]);
        assert!(number(row, "found") >= 0.98 * visible, "row {row}");
        assert!(number(row, "error_over_sigma") < 1.15, "row {row}");
        let (rms, sigma) = (number(row, "object_rms"), number(row, "object_sigma"));
        assert!((0.7..1.4).contains(&(rms / sigma)), "row {row}: {rms} of {sigma}");
    }
    assert!((0.93..1.07).contains(&number(0, "error_over_sigma")));
    for row in 3..6 {
        assert!(number(row, "over_sites") > 1.2, "row {row}: {}", number(row, "over_sites"));
    }
}
