//! Files of other programs, as they come.

use crate::support::data::{data, text};
use sightline::project::{Interior, Project, Role, Sigma};
use sightline_exchange::{self as exchange, Files, control_csv};

fn import(format: &str, paths: &[&str]) -> Option<Project> {
    let mut files = Files::new();
    for path in paths {
        files.insert((*path).to_owned(), data(path)?);
    }
    Some(exchange::import(format, &files).unwrap_or_else(|error| panic!("{paths:?}: {error}")))
}

fn count(project: &Project, role: Role) -> usize {
    project.points.iter().filter(|point| point.role == role).count()
}

fn near(value: f64, expected: f64) {
    assert!((value - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{value} is not {expected}");
}

#[test]
fn photomodeler_calibration() {
    let Some(project) = import("photomodeler", &["camcal/camcal-pmexport.txt"]) else { return };
    assert_eq!((project.photos.len(), project.points.len(), project.observations.len()), (21, 100, 2074));
    assert_eq!((project.cameras.len(), count(&project, Role::Control)), (1, 0));
    let camera = &project.cameras[0];
    assert_eq!((camera.width, camera.height), (2272, 1704));
    let Interior::Brown { c, x0, y0, k1, p2, .. } = camera.interior else { panic!("a brown model") };
    assert_eq!((c, k1, p2), (Some(7.4653), 0.00498, -0.00004));
    near(x0, 3.6173 - 7.25319 / 2.0);
    near(y0, 5.43764 / 2.0 - 2.6128);
    assert_eq!(project.photos[20].file, "P8250041.JPG");
    near(project.photos[0].rotation.expect("oriented")[2], (-179.839f64).to_radians());
    assert_eq!(project.observations[0].sigma, Sigma::Two([0.1, 0.1]));
    let (one_ray, fewer) = (
        import("photomodeler", &["camcal/camcal-pmexport-1ray.txt"]),
        import("photomodeler", &["camcal/camcal-pmexport-missing-obs.txt"]),
    );
    assert!(
        one_ray.expect("beside the other").observations.len() < 2074
            && fewer.expect("beside the other").observations.len() < 2074
    );
}

#[test]
fn photomodeler_aerial_block_with_control() {
    let Some(fixed) = import("photomodeler", &["sxb/f-op0-with-orient-pmexport.txt"]) else { return };
    assert_eq!((fixed.photos.len(), count(&fixed, Role::Control), count(&fixed, Role::Tie)), (5, 16, 0));
    assert!(fixed.points.iter().all(|point| point.sigma.is_none()));
    let more = import("photomodeler", &["sxb/w-op1-with-orient-pmexport.txt"]).expect("beside the other");
    assert_eq!((count(&more, Role::Control), count(&more, Role::Tie)), (16, 1));
    assert_eq!(more.points[0].sigma, Some([Some(0.016403), Some(0.016291), Some(0.034382)]));
    assert_eq!(more.observations.len(), fixed.observations.len() + 4);
}

#[test]
fn dbat_project_with_control_and_check_points() {
    let paths = [
        "sxb/sxb.xml",
        "sxb/reference/sxb-control.txt",
        "sxb/images/images.txt",
        "sxb/measurements/markpts.txt",
        "sxb/measurements/smartpts.txt",
    ];
    let Some(project) = import("dbat", &paths) else { return };
    assert_eq!((count(&project, Role::Control), count(&project, Role::Check)), (14, 2));
    let used = project.observations.iter().filter(|observation| observation.enabled).count();
    // 2392 image coordinates are in the published report.
    assert_eq!(used, 2392 / 2);
    assert_eq!(project.unit, "m");
    let camera = &project.cameras[0];
    near(camera.pixel_pitch.expect("a pitch")[0], 0.006);
    let Interior::Brown { c, x0, .. } = camera.interior else { panic!("a brown model") };
    assert_eq!(c, Some(123.9392));
    near(x0, 26.577 - 53.148 / 2.0);
    assert_eq!(project.photos[0].file, "8811.jpg");
    assert!(
        project.observations.iter().any(|o| o.sigma == Sigma::One(0.5))
            && project.observations.iter().any(|o| o.sigma == Sigma::One(1.0))
    );
}

#[test]
fn control_lists() {
    for (path, count, sigma) in [
        ("camcal/camcal-fixed.txt", 4, None),
        ("sxb/ctrlpts-fixed.txt", 16, None),
        ("sxb/ctrlpts-weighted.txt", 16, Some([Some(0.02), Some(0.02), Some(0.04)])),
        ("sxb/reference/sxb-control.txt", 16, Some([Some(0.02), Some(0.02), Some(0.04)])),
        ("panel/Positions-3D-14bit_lookup.txt", 239, None),
    ] {
        let Some(list) = text(path) else { return };
        let points = control_csv::parse(&list).into_points().unwrap_or_else(|error| panic!("{path}: {error}"));
        assert_eq!(points.len(), count, "{path}");
        assert!(points.iter().all(|point| point.sigma == sigma), "{path}");
    }
    let aicon = import("aicon", &["panel/Positions-3D-14bit_lookup.txt"]).expect("read above");
    let same = import("control-csv", &["panel/Positions-3D-14bit_lookup.txt"]).expect("read above");
    assert_eq!(aicon.points, same.points);
    assert_eq!(aicon.points[0].xyz, Some([-0.2, -0.1216, -0.3116]));
}

#[test]
fn marks_survive_the_way_out_and_back() {
    let Some(project) = import("mark-points", &["camcal/markpts.txt"]) else { return };
    assert_eq!((project.photos.len(), project.points.len(), project.observations.len()), (21, 100, 2074));
    let files = exchange::export("mark-points", &project, None).expect("a text");
    let again = exchange::import("mark-points", &files).expect("its own text");
    let both = |project: &Project| {
        project
            .observations
            .iter()
            .map(|o| (o.photo.clone(), o.point.clone(), o.u, o.v, o.sigma.both()))
            .collect::<Vec<_>>()
    };
    assert_eq!(both(&again), both(&project));
}

#[test]
fn every_format_says_what_it_cannot_read() {
    let foreign = Files::from([("a.bin".to_owned(), vec![0x89, b'P', b'N', b'G', 0, 0, 1, 255])]);
    for format in exchange::FORMATS {
        if format.import {
            let error = exchange::import(format.name, &foreign).expect_err(format.name);
            assert!(!error.to_string().is_empty());
            assert_eq!(exchange::import(format.name, &Files::new()).expect_err(format.name).code(), "empty");
        } else {
            assert_eq!(exchange::import(format.name, &foreign).expect_err(format.name).code(), "unknown");
        }
    }
    let error = exchange::import("docx", &foreign).expect_err("no such format");
    assert_eq!(error.code(), "unknown");
    assert!(error.to_string().contains("photomodeler"), "the sentence names the formats: {error}");
    assert_eq!(exchange::export("docx", &Project::default(), None).expect_err("no such format").code(), "unknown");
}

#[test]
fn every_export_of_its_own_is_read_again() {
    let project = Project { name: "n".into(), ..Project::default() };
    for format in ["sightline", "package"] {
        let files = exchange::export(format, &project, None).expect(format);
        assert_eq!(exchange::import(format, &files).expect(format), project);
    }
}
