//! The network of the lessons: fourteen targets on a stepped plate in five convergent photos of one camera, four of them control points.
//! And start values that are off, so that there is something to iterate.

use sightline::error::Result;
use sightline::noise::Noise;
use sightline::project::{Camera, Datum, DatumKind, Interior, Parameter, Project, Role, Sigma};
use sightline_plan::network::{Network, NetworkPoint, Station, simulate};

/// Corners of the plate: control points.
const CONTROL: [usize; 4] = [1, 4, 9, 12];
/// Standard error of a control coordinate, mm.
const CONTROL_SIGMA: f64 = 0.02;

/// The network, simulated with one seed: the same for everybody.
///
/// # Errors
/// Those of [`simulate`]; none are known.
pub fn lab() -> Result<Project> {
    let interior = Interior::Brown {
        c: Some(28.31),
        x0: -0.08,
        y0: 0.05,
        k1: -1.3e-4,
        k2: 0.0,
        k3: 0.0,
        p1: 0.0,
        p2: 0.0,
        b1: 0.0,
        b2: 0.0,
    };
    let mut camera = Camera::new("lab camera", 4000, 3000, interior);
    camera.pixel_pitch = Some([0.006; 2]);
    camera.free = vec![Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1];
    // Without steps the plate is a plane, in which the principal distance and the height of the photos cannot be distinguished.
    let heights = [0.0, 60.0, 120.0, 20.0, 90.0, 150.0, 140.0, 80.0, 30.0, 110.0, 70.0, 10.0, 40.0, 130.0];
    let place = |k: usize| match k {
        0..12 => [400.0 * (k % 4) as f64, 350.0 * (k / 4) as f64, heights[k]],
        12 => [600.0, 520.0, heights[k]],
        _ => [600.0, 180.0, heights[k]],
    };
    let points = (0..14).map(|k| NetworkPoint {
        id: (k + 1).to_string(),
        role: if CONTROL.contains(&(k + 1)) { Role::Control } else { Role::Tie },
        xyz: place(k),
        sigma: CONTROL.contains(&(k + 1)).then_some([Some(CONTROL_SIGMA); 3]),
        normal: Some([0.0, 0.0, 1.0]),
        ..NetworkPoint::default()
    });
    let aim = [600.0, 350.0, 60.0];
    let quarter = std::f64::consts::FRAC_PI_2;
    let stations = [
        ([-300.0, 350.0, 1650.0], 0.0),
        ([850.0, -760.0, 1500.0], 0.0),
        ([1500.0, 350.0, 1650.0], quarter),
        ([350.0, 1460.0, 1500.0], 2.0 * quarter),
        ([600.0, 350.0, 1900.0], quarter),
    ];
    let stations = stations
        .iter()
        .enumerate()
        .map(|(k, (position, roll))| Station::aimed((k + 1).to_string(), "lab camera", *position, aim, *roll));
    let mut project = simulate(&Network {
        name: "Lab net".into(),
        cameras: vec![camera],
        stations: stations.collect(),
        points: points.collect(),
        datum: Datum { kind: DatumKind::Control, points: None },
        sigma: Sigma::One(0.05),
        seed: 11,
        ..Network::default()
    })?;
    // Targets lie flat, whatever their heights: from neighbours on a stepped plate no normal could be estimated.
    project.points.iter_mut().for_each(|point| point.normal = Some([0.0, 0.0, 1.0]));
    Ok(project)
}

/// The project with start values that are off by `share` of the largest distance between two points, normally distributed per coordinate;
/// photos are also turned by as many radians. What is given (control points, observed values) stays.
pub fn moved(project: &Project, share: f64) -> Project {
    let mut project = project.clone();
    if share == 0.0 {
        return project;
    }
    let size = extent(&project);
    let mut noise = Noise::new(1, 1);
    let mut off = |x: [f64; 3], by: f64| x.map(|x| x + by * noise.normal());
    for photo in &mut project.photos {
        photo.position = photo.position.map(|position| off(position, share * size));
        photo.rotation = photo.rotation.map(|rotation| off(rotation, share));
    }
    // Under other datums than control the coordinates of control points are start values too; they stay, so that the system does.
    for point in project.points.iter_mut().filter(|point| point.role != Role::Control) {
        point.xyz = point.xyz.map(|xyz| off(xyz, share * size));
    }
    project
}

fn extent(project: &Project) -> f64 {
    let all = || project.points.iter().filter_map(|point| point.xyz);
    let along = |axis: usize| {
        let low = all().map(|xyz| xyz[axis]).fold(f64::INFINITY, f64::min);
        let high = all().map(|xyz| xyz[axis]).fold(f64::NEG_INFINITY, f64::max);
        (high - low).max(0.0)
    };
    let size = (0..3).map(|axis| along(axis).powi(2)).sum::<f64>().sqrt();
    if size.is_finite() { size } else { 0.0 }
}
