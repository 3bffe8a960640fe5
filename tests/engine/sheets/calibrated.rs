//! A calibration sheet in rendered photos: dots get names and diameters of its control file, and the camera is right with them.

use nalgebra::Vector3;
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Termination};
use sightline::detect::detect;
use sightline::detection::{Codes, DetectOptions};
use sightline::matching::{MatchOptions, PhotoTargets, match_uncoded, name_coded};
use sightline::orient::orient;
use sightline::project::{Camera, DatumKind, Distance, Interior, Parameter, Photo, Point, Project, Role};
use sightline::ring_code::Family;
use sightline_exchange::control_csv;
use sightline_plan::network::{Network, NetworkPoint, Station, photo};
use sightline_plan::scene::{Face, Ring};
use sightline_report::sheets::{Field, SheetOptions, Sheets, target_sheets};

const FAMILY: Family = Family::Ring14;
const FOCAL: f64 = 1500.0;

fn sheet() -> Sheets {
    let field = Some(Field { columns: 1, rows: 1 });
    target_sheets(&SheetOptions { family: FAMILY, diameter: 8.0, field, ..SheetOptions::default() }).expect("a sheet")
}

/// The sheet on a table, from eight sides.
fn network(sheets: &Sheets) -> Network {
    let point = |target: &sightline_report::sheets::Printed| {
        let [x, y] = target.plate?;
        let ring = target.number.map(|number| Ring {
            sectors: FAMILY.bits(),
            code: FAMILY.codes()[number as usize - 1],
            design: FAMILY.design(),
        });
        Some(NetworkPoint {
            id: target.id.clone(),
            xyz: [x, y, 0.0],
            normal: Some([0.0, 0.0, 1.0]),
            diameter: Some(sheets.diameter),
            ring,
            grey: Some(0.05),
            ..NetworkPoint::default()
        })
    };
    let middle = [105.0, 148.0, 0.0];
    let station = |k: u32| {
        let (turn, tilt) = (f64::from(k) * 0.8, if k.is_multiple_of(2) { 0.75_f64 } else { 0.3 });
        let range = 360.0;
        let position = [
            middle[0] + range * tilt.sin() * turn.cos(),
            middle[1] + range * tilt.sin() * turn.sin(),
            range * tilt.cos(),
        ];
        Station::aimed(format!("p{k}"), "c", position, middle, f64::from(k % 4) * std::f64::consts::FRAC_PI_2)
    };
    Network {
        cameras: vec![Camera::new("c", 1400, 1100, Interior::brown(FOCAL))],
        stations: (0..8).map(station).collect(),
        points: sheets.targets.iter().filter_map(point).collect(),
        faces: vec![Face {
            corner: [-30.0, -30.0, -0.01],
            along: [270.0, 0.0, 0.0],
            across: [0.0, 357.0, 0.0],
            grey: 0.85,
            texture: 0.0,
            grain: 1.0,
        }],
        background: 0.3,
        ..Network::default()
    }
}

fn measured(network: &Network) -> Vec<PhotoTargets> {
    let options = DetectOptions { codes: Codes::from(FAMILY), ..DetectOptions::default() };
    let one = |station: &Station| {
        let grey = photo(network, &station.id).expect("rendered");
        let targets = detect(&grey.view().expect("a picture"), &options).expect("targets").targets;
        PhotoTargets { photo: station.id.clone(), targets }
    };
    network.stations.iter().map(one).collect()
}

/// Codes named, given points as they are, everything oriented.
fn oriented(network: &Network, targets: &[PhotoTargets], points: Vec<Point>) -> Project {
    let free = vec![Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2];
    let camera = Camera { free, ..Camera::new("c", 1400, 1100, Interior::brown(1.05 * FOCAL)) };
    let photo = |s: &Station| Photo { id: s.id.clone(), camera: "c".into(), enabled: true, ..Photo::default() };
    let coded = name_coded(targets, Some(FAMILY));
    let mut project = Project {
        cameras: vec![camera],
        photos: network.stations.iter().map(photo).collect(),
        points: points.into(),
        observations: coded.observations.into(),
        ..Project::default()
    };
    for point in coded.points {
        if project.points.iter().all(|known| known.id != point.id) {
            project.points.push(point);
        }
    }
    let is_given = project.points.iter().any(|p| p.role == Role::Control);
    project.datum.kind = if is_given { DatumKind::Control } else { DatumKind::Free };
    if !is_given {
        let (a, b) = (&network.points[0], network.points.iter().rfind(|p| p.ring.is_some()).expect("codes"));
        let length = (Vector3::from(a.xyz) - Vector3::from(b.xyz)).norm();
        project.distances.push(Distance { from: a.id.clone(), to: b.id.clone(), length, sigma: 0.02, check: false });
    }
    orient(&project).expect("oriented").project
}

fn adjusted(project: &Project) -> Adjustment {
    let found = adjust(project, &AdjustOptions::default(), &mut |_| true).expect("a result");
    assert_eq!(found.termination, Termination::Converged);
    found
}

/// Error of the principal distance in its standard errors.
fn off(found: &Adjustment) -> f64 {
    let camera = &found.cameras[0];
    (camera.camera.interior.get(Parameter::C).expect("estimated") - FOCAL) / camera.sigma[&Parameter::C]
}

#[test]
fn dots_of_a_sheet_are_those_of_its_control_file() {
    let sheets = sheet();
    let network = network(&sheets);
    let targets = measured(&network);
    let files = sheets.files();
    let (_, control) = files.iter().find(|(name, _)| name == "control.csv").expect("a field has one");
    let control = control_csv::parse(std::str::from_utf8(control).expect("text")).into_points().expect("points");
    let dots = network.points.iter().filter(|p| p.ring.is_none()).count();
    assert!(dots >= 20 && control.iter().all(|p| p.diameter == Some(8.0)), "{dots}");

    let project = oriented(&network, &targets, control);
    let matching = match_uncoded(&project, &targets, &MatchOptions::default()).expect("a valid project");
    let beside = |p: &&Point| {
        let xyz = Vector3::from(p.xyz.unwrap_or_default());
        network.points.iter().any(|known| (xyz - Vector3::from(known.xyz)).norm() < 4.0)
    };
    assert_eq!(matching.points.iter().filter(beside).count(), 0, "{:?}", matching.points);
    let mut all = project.clone();
    all.points.extend(matching.points.clone());
    all.observations.extend(matching.observations.clone());
    for dot in network.points.iter().filter(|p| p.ring.is_none()) {
        let rays = matching.observations.iter().filter(|o| o.point == dot.id).count();
        assert!(rays >= 4, "{} of {}", rays, dot.id);
    }
    // None has another's name.
    for o in &matching.observations {
        let index = network.stations.iter().position(|s| s.id == o.photo).expect("its photo");
        let pose = network.stations[index].pose().expect("a pose");
        let known = network.points.iter().find(|p| p.id == o.point).expect("a dot");
        let p = pose.to_camera(&Vector3::from(known.xyz));
        let at = sightline::camera::pixel_from_camera_point(&network.cameras[0], p).expect("in front");
        assert!((at[0] - o.u).hypot(at[1] - o.v) < 3.0, "{} in {}", o.point, o.photo);
    }
    // The sheet came out exactly as it was drawn: its own standard errors are small.
    for point in all.points.iter_mut() {
        point.sigma = Some([Some(0.001); 3]);
    }
    let with = off(&adjusted(&all));
    for point in all.points.iter_mut() {
        point.diameter = None;
    }
    let without = off(&adjusted(&all));
    println!("principal distance off by {with:.2} standard errors with diameters, {without:.2} without; {dots} dots");
    assert!(with.abs() < 4.0 && without.abs() > 1.5 * with.abs().max(2.0), "{with} {without}");
}

#[test]
fn new_points_have_the_diameter_that_their_images_show() {
    let sheets = sheet();
    let network = network(&sheets);
    let targets = measured(&network);
    let project = oriented(&network, &targets, Vec::new());
    let matching = match_uncoded(&project, &targets, &MatchOptions::default()).expect("a valid project");
    assert!(matching.points.len() >= 18, "{}", matching.points.len());
    for point in &matching.points {
        let diameter = point.diameter.expect("the distance fixes the scale");
        assert!((diameter - 8.0).abs() < 0.15, "{} {diameter}", point.id);
    }
    // In a model of any scale a diameter has no meaning.
    let bare = Project { distances: Vec::new(), ..project };
    let matching = match_uncoded(&bare, &targets, &MatchOptions::default()).expect("a valid project");
    assert!(!matching.points.is_empty() && matching.points.iter().all(|point| point.diameter.is_none()));
}
