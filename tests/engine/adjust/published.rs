//! Networks with published answers: the camera calibration and the aerial block of DBAT, a textbook's resection.

use crate::support::data;
use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, Adjustment, Advice, ResidualPlace, Termination};
use sightline::error::{Defect, Error};
use sightline::project::{Camera, DatumKind, Interior, Observation, Parameter, Photo, Point, Project, Role, Sigma};
use sightline_exchange::photomodeler;
pub const HEIGHT_MM: f64 = 5.43764;

fn solve(project: &Project) -> Adjustment {
    let options = AdjustOptions { residuals: ResidualPlace::Corrected, ..AdjustOptions::default() };
    let adjustment = adjust(project, &options, &mut |_| true).expect("solvable");
    nothing_is_asked(&adjustment);
    adjustment
}

/// Published data sets are plausible.
pub fn nothing_is_asked(adjustment: &Adjustment) {
    let asks = |advice: &&Advice| {
        matches!(
            advice,
            Advice::MirroredControl(_)
                | Advice::UndecidedAxes(_)
                | Advice::UnitRatio(_)
                | Advice::OneStation(_)
                | Advice::ImplausibleCamera(_)
        )
    };
    let asked: Vec<&Advice> = adjustment.advice.iter().filter(asks).collect();
    assert!(asked.is_empty(), "{asked:?}");
}

/// The calibration project with the sheet's four control points fixed, free of what the published runs estimate.
pub fn camcal(file: &str, free: &[Parameter]) -> Option<Project> {
    let mut project = photomodeler::parse(&data::text(&format!("camcal/{file}"))?).expect("a valid export");
    let pitch = HEIGHT_MM / 1704.0;
    project.cameras.truncate(1);
    let camera = &mut project.cameras[0];
    camera.pixel_pitch = Some([pitch, pitch]);
    camera.interior = Interior::brown(7.3);
    camera.free = free.to_vec();
    let id = camera.id.clone();
    project.photos.iter_mut().for_each(|photo| photo.camera.clone_from(&id));
    for line in data::text("camcal/camcal-fixed.txt")?.lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split(',').collect();
        let xyz = [2, 3, 4].map(|k| fields[k].trim().parse().expect("a coordinate"));
        project.points.retain(|p| p.id != fields[0]);
        project.points.push(Point { id: fields[0].into(), role: Role::Control, xyz: Some(xyz), ..Point::default() });
    }
    project.datum.kind = DatumKind::Control;
    Some(project)
}

pub const DISTORTED: [Parameter; 8] = [
    Parameter::C,
    Parameter::X0,
    Parameter::Y0,
    Parameter::K1,
    Parameter::K2,
    Parameter::K3,
    Parameter::P1,
    Parameter::P2,
];

/// A published value within `part` of its sigma.
fn agrees(adjustment: &Adjustment, parameter: Parameter, value: f64, sigma: f64, part: f64) {
    let got = adjustment.cameras[0].camera.interior.get(parameter).expect("a parameter of the model");
    let name = parameter.name();
    assert!((got - value).abs() <= part * sigma, "{name} {got} is not {value} ({} sigmas)", (got - value) / sigma);
}

/// Parameters of the published run with their sigmas, in order of [`DISTORTED`]; x0 and y0 from the top left corner.
const PUBLISHED: [(f64, f64); 8] = [
    (7.457, 1.05e-3),
    (3.61546, 8.2e-4),
    (2.61329, 9.8e-4),
    (0.004_588_61, 2.21e-5),
    (-4.513_51e-5, 2.65e-6),
    (-2.052_53e-6, 1.01e-7),
    (-6.128_03e-5, 3.52e-6),
    (-4.411_72e-5, 3.94e-6),
];

#[test]
fn the_camera_calibration_has_the_published_answer() {
    let mut free = DISTORTED.to_vec();
    free.push(Parameter::B1);
    let Some(project) = camcal("camcal-pmexport.txt", &free) else { return };
    let adjustment = solve(&project);
    assert_eq!(adjustment.termination, Termination::Converged);
    assert_eq!((adjustment.observations_count, adjustment.unknowns, adjustment.redundancy), (4148, 423, 3725));
    let sigma0 = adjustment.sigma0.expect("redundant");
    // Our affinity stands beside the distortion: an independent adjustment of it gave 1.61219 and b1 4.110e-4.
    assert!((sigma0 - 1.61219).abs() < 5e-5, "{sigma0}");
    let b1 = adjustment.cameras[0].camera.interior.get(Parameter::B1).expect("b1");
    assert!((b1 - 4.110e-4).abs() < 1e-6, "{b1}");
    for (parameter, (_, sigma)) in DISTORTED.into_iter().zip(PUBLISHED) {
        let got = adjustment.cameras[0].sigma[&parameter];
        assert!((got / sigma - 1.0).abs() < 0.01, "sigma of {} {got} is not {sigma}", parameter.name());
    }
    assert!(adjustment.iterations.len() <= 9, "{} iterations", adjustment.iterations.len());
}

#[test]
fn the_calibration_with_the_published_affinity_agrees_in_every_parameter() {
    let Some(mut project) = camcal("camcal-pmexport.txt", &DISTORTED) else { return };
    let pitch = HEIGHT_MM / 1704.0;
    project.cameras[0].pixel_pitch = Some([pitch * (1.0 + 3.89598e-4), pitch]);
    let adjustment = solve(&project);
    let sigma0 = adjustment.sigma0.expect("redundant");
    assert!((sigma0 - 1.61424).abs() < 5e-5, "{sigma0}");
    assert_eq!(adjustment.redundancy, 3726);
    let (width, height) = (2272.0 * pitch, HEIGHT_MM);
    for (parameter, (mut value, sigma)) in DISTORTED.into_iter().zip(PUBLISHED) {
        match parameter {
            // Counted from the top left corner there; x carries the affinity.
            Parameter::X0 => value = (value - width / 2.0) * (1.0 + 3.89598e-4),
            Parameter::Y0 => value = height / 2.0 - value,
            _ => {}
        }
        // c is printed with three decimals only.
        agrees(&adjustment, parameter, value, sigma, if parameter == Parameter::C { 0.5 } else { 0.05 });
    }
    let correlation = &adjustment.cameras[0].correlation;
    let at = |name| correlation.names.iter().position(|n| n == name).expect("estimated");
    assert!((correlation.matrix[at("k2")][at("k3")] + 0.979).abs() < 1e-3);
    let given: f64 = adjustment.given.iter().filter_map(|g| g.reliability).map(|r| r.redundancy).sum();
    let image: f64 = adjustment.observations.iter().flat_map(|o| [o.rx, o.ry]).flatten().sum();
    assert!((image + given - 3726.0).abs() < 1e-6, "redundancy numbers sum to {}", image + given);
    // Adjusted again from its own result, nothing moves.
    let again = solve(&apply(&project, &adjustment));
    assert!((again.sigma0.expect("redundant") - sigma0).abs() < 1e-9);
    assert!(again.iterations.len() <= 2, "{}", again.iterations.len());
}

#[test]
fn failures_of_the_calibration_are_named() {
    let named = |project: &Project| match adjust(project, &AdjustOptions::default(), &mut |_| true) {
        Err(Error::RankDefect { defects }) => defects,
        other => panic!("{:?}", other.map(|a| a.sigma0)),
    };
    let Some(project) = camcal("camcal-pmexport-1ray.txt", &DISTORTED) else { return };
    assert_eq!(named(&project), [Defect::TooFewRays { points: vec!["88".into()] }]);
    let Some(project) = camcal("camcal-pmexport-missing-obs.txt", &DISTORTED) else { return };
    let defects = named(&project);
    let [Defect::TooFewRays { points }] = &defects[..] else { panic!("{defects:?}") };
    assert!(points.contains(&"13".to_string()) && points.contains(&"60".to_string()) && points.len() == 2);
    let Some(mut project) = camcal("camcal-pmexport.txt", &DISTORTED) else { return };
    project.points.iter_mut().for_each(|p| p.role = Role::Tie);
    assert_eq!(named(&project), [Defect::NoDatum { missing: 7 }]);
}

#[test]
fn the_textbook_resection_is_reproduced() {
    let camera = Camera {
        id: "k".into(),
        width: 230,
        height: 230,
        pixel_pitch: Some([1.0, 1.0]),
        interior: Interior::brown(153.24),
        free: Vec::new(),
        sigma: Default::default(),
        per_photo: false,
    };
    let rows = [
        ([-86.15, -68.99], [36589.41, 25273.32, 2195.17]),
        ([-53.40, 82.21], [37631.08, 31324.51, 728.69]),
        ([-14.78, -76.63], [39100.97, 24934.98, 2386.50]),
        ([10.46, 64.43], [40426.54, 30319.81, 757.31]),
    ];
    let mut project = Project { unit: "m".into(), ..Project::default() };
    for (k, (xy, xyz)) in rows.into_iter().enumerate() {
        let [u, v] = camera.pixel_from_photo(xy);
        let point = (k + 1).to_string();
        project.points.push(Point { id: point.clone(), role: Role::Control, xyz: Some(xyz), ..Point::default() });
        project.observations.push(Observation {
            photo: "1".into(),
            point,
            u,
            v,
            sigma: Sigma::One(0.001),
            enabled: true,
            target: None,
        });
    }
    project.photos.push(Photo {
        id: "1".into(),
        camera: "k".into(),
        position: Some([39000.0, 28000.0, 7000.0]),
        rotation: Some([0.0, 0.0, 0.0]),
        enabled: true,
        ..Photo::default()
    });
    project.cameras.push(camera);
    project.datum.kind = DatumKind::Control;
    let adjustment = solve(&project);
    assert_eq!(adjustment.redundancy, 2);
    assert!((adjustment.sigma0.expect("redundant") - 7.26).abs() < 0.005, "{:?}", adjustment.sigma0);
    let photo = &adjustment.photos[0];
    for (got, expected) in photo.position.iter().zip([39795.45, 27476.46, 7572.69]) {
        assert!((got - expected).abs() < 0.006, "{:?}", photo.position);
    }
    for (got, expected) in photo.rotation.iter().zip([0.002114, 0.003987, -0.067586]) {
        assert!((got - expected).abs() < 1e-6, "{:?}", photo.rotation);
    }
}
