//! A small sound network whose document is damaged: by the fuzzer place by place, by a test where the fuzzer found something.

use sightline::project::{Camera, DatumKind, Distance, Interior, Parameter, Project, Role};
use sightline_plan::network::{self, Network, NetworkPoint, Station};

/// Five photos around twelve points, with observations of every kind; the bits of `seed` choose a second camera, one that is estimated photo by photo, and the
/// datum.
pub fn seed_document(seed: u32) -> Project {
    let station = |k: u32| {
        let turn = f64::from(k) * 1.3;
        let position = [900.0 * turn.cos(), 900.0 * turn.sin(), 800.0 + 50.0 * f64::from(k)];
        let camera = if seed & 1 == 1 && k % 2 == 1 { "other" } else { "c" };
        Station::aimed(format!("f{k}"), camera, position, [0.0; 3], turn)
    };
    let point = |k: u32| NetworkPoint {
        id: format!("p{k}"),
        xyz: [200.0 * (f64::from(k) * 2.4).cos(), 200.0 * (f64::from(k) * 2.4).sin(), 20.0 * f64::from(k * 5 % 7)],
        ..NetworkPoint::default()
    };
    let brown = Camera { pixel_pitch: Some([0.005; 2]), ..Camera::new("c", 2000, 1500, Interior::brown(9.0)) };
    let opencv = Interior::Opencv {
        fx: Some(1800.0),
        fy: Some(1805.0),
        cx: 1000.0,
        cy: 750.0,
        k1: 0.01,
        k2: 0.0,
        p1: 0.0,
        p2: 0.0,
        k3: 0.0,
    };
    let network = Network {
        cameras: vec![brown, Camera::new("other", 2000, 1500, opencv)],
        stations: (0..5).map(station).collect(),
        points: (0..12).map(point).collect(),
        ..Network::default()
    };
    let mut project = network::simulate(&network).expect("a sound network");
    project.cameras[0].free = vec![Parameter::C, Parameter::K1];
    project.cameras[0].sigma = [(Parameter::X0, 0.01)].into();
    project.cameras[0].per_photo = seed & 2 == 2;
    project.datum.kind = [DatumKind::Free, DatumKind::Minimal, DatumKind::Control][seed as usize / 4 % 3];
    for point in &mut project.points[..4] {
        (point.role, point.sigma) = (Role::Control, Some([Some(0.1), Some(0.1), None]));
        point.diameter = Some(10.0);
    }
    project.photos[1].sigma_position = Some([Some(1.0), None, Some(1.0)]);
    let distance =
        |from: &str, to: &str| Distance { from: from.into(), to: to.into(), length: 200.0, sigma: 50.0, check: false };
    project.distances = vec![distance("p5", "p6"), distance("p7", "p8")];
    project
}
