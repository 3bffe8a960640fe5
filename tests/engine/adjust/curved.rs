//! Circular targets on surfaces of many forms: stating their diameter frees them of the eccentricity, or leaves them as they are, and
//! never makes the object worse.

use crate::support::networks::{Uniform, brown};
use nalgebra::{Matrix3, Vector3};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, AdjustedPoint, Adjustment};
use sightline::camera::pixel_from_camera_point;
use sightline::eccentricity::{TargetCircle, pixels};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Observation, Parameter, Photo, Point, Project, Sigma};
use sightline::rotation;

const DIAMETER: f64 = 30.0;
const NOISE: f64 = 0.02;

/// Place and normal of every target.
type Targets = Vec<(Vector3<f64>, Vector3<f64>)>;

/// A half sphere of 400 mm, its targets in a spiral.
fn dome(count: usize) -> Targets {
    let place = |k: usize| {
        let z = (k as f64 + 0.5) / count as f64;
        let (sin, cos) = (2.399_963_23 * k as f64).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vector3::new(radius * cos, radius * sin, z)
    };
    (0..count).map(place).map(|n| (400.0 * n, n)).collect()
}

/// Half a cylinder that lies on the ground, 800 mm long.
fn cylinder(count: usize) -> Targets {
    let rows = (count as f64).sqrt() as usize;
    let place = |k: usize| {
        let (sin, cos) = (std::f64::consts::PI * ((k % rows) as f64 + 0.5) / rows as f64).sin_cos();
        let n = Vector3::new(cos, 0.0, sin);
        (300.0 * n + Vector3::y() * (800.0 * (k / rows) as f64 / rows as f64 - 400.0), n)
    };
    (0..rows * rows).map(place).collect()
}

/// z = (x² - y²)/1000 mm.
fn saddle(count: usize) -> Targets {
    let mut random = Uniform(3);
    let mut place = || {
        let [x, y] = [random.between(-400.0, 400.0), random.between(-400.0, 400.0)];
        (Vector3::new(x, y, (x * x - y * y) / 1000.0), Vector3::new(-x / 500.0, y / 500.0, 1.0).normalize())
    };
    (0..count).map(|_| place()).collect()
}

/// The top and four sides of a box.
fn cube(count: usize) -> Targets {
    let mut random = Uniform(4);
    let place = |k: usize| {
        let [a, b] = [random.between(-300.0, 300.0), random.between(-300.0, 300.0)];
        match k % 5 {
            0 => (Vector3::new(a, b, 300.0), Vector3::z()),
            1 => (Vector3::new(300.0, a, b), Vector3::x()),
            2 => (Vector3::new(-300.0, a, b), -Vector3::x()),
            3 => (Vector3::new(a, 300.0, b), Vector3::y()),
            _ => (Vector3::new(a, -300.0, b), -Vector3::y()),
        }
    };
    (0..count).map(place).collect()
}

/// Targets in space that face up, more or less.
fn cloud(count: usize) -> Targets {
    let mut random = Uniform(5);
    let mut place = || {
        let at = [400.0, 400.0, 200.0].map(|half| random.between(-half, half));
        let n = Vector3::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5), 1.0).normalize();
        (Vector3::from(at), n)
    };
    (0..count).map(|_| place()).collect()
}

/// Twelve photos around and above; a target is seen under less than 70 degrees. The eccentricity moves targets along their normals:
/// eight points around, which are no targets, define the datum, so that this is not taken for a change of scale.
fn seen(targets: &Targets, seed: u64) -> Project {
    let mut project =
        Project { cameras: vec![brown(&[Parameter::C, Parameter::X0, Parameter::Y0])], ..Project::default() };
    project.datum.kind = DatumKind::Free;
    let mut noise = Noise::new(seed, 0);
    for (k, (place, _)) in targets.iter().enumerate() {
        let (xyz, diameter) = (Some((*place).into()), Some(DIAMETER));
        project.points.push(Point { id: k.to_string(), xyz, diameter, ..Point::default() });
    }
    let around: Vec<Vector3<f64>> = (0..8)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::FRAC_PI_4 * f64::from(k)).sin_cos();
            Vector3::new(550.0 * cos, 550.0 * sin, 60.0 * f64::from(k % 3))
        })
        .collect();
    for (k, place) in around.iter().enumerate() {
        project.points.push(Point { id: format!("r{k}"), xyz: Some((*place).into()), ..Point::default() });
    }
    project.datum.points = Some((0..8).map(|k| format!("r{k}")).collect());
    for k in 0..12 {
        let (sin, cos) = (std::f64::consts::FRAC_PI_6 * f64::from(k)).sin_cos();
        let elevation = if k % 2 == 0 { 0.5_f64 } else { 1.0 };
        let centre = 1700.0 * Vector3::new(cos * elevation.cos(), sin * elevation.cos(), elevation.sin());
        let z = centre.normalize();
        let x = Vector3::z().cross(&z).normalize();
        let (x, y) = if k % 4 < 2 { (x, z.cross(&x)) } else { (z.cross(&x), -x) };
        let m = Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]);
        let id = format!("f{k}");
        for (point, (place, normal)) in targets.iter().enumerate() {
            if (centre - place).normalize().dot(normal) < 0.34 {
                continue;
            }
            let circle = TargetCircle { centre: m * (place - centre), normal: m * normal, diameter: DIAMETER };
            let camera = &project.cameras[0];
            let [u, v] = pixel_from_camera_point(camera, circle.centre).expect("in front");
            let [du, dv] = pixels(camera, &circle).expect("seen");
            project.observations.push(Observation {
                photo: id.clone(),
                point: point.to_string(),
                u: u + du + NOISE * noise.normal(),
                v: v + dv + NOISE * noise.normal(),
                sigma: Sigma::One(NOISE),
                enabled: true,
                target: None,
            });
        }
        for (k, place) in around.iter().enumerate() {
            let [u, v] = pixel_from_camera_point(&project.cameras[0], m * (place - centre)).expect("in front");
            let (u, v) = (u + NOISE * noise.normal(), v + NOISE * noise.normal());
            let (point, sigma) = (format!("r{k}"), Sigma::One(NOISE));
            project.observations.push(Observation {
                photo: id.clone(),
                point,
                u,
                v,
                sigma,
                enabled: true,
                target: None,
            });
        }
        project.photos.push(Photo {
            id,
            camera: "brown".into(),
            position: Some(centre.into()),
            rotation: Some(rotation::angles(&m)),
            enabled: true,
            ..Photo::default()
        });
    }
    let rays = |id: &str| project.observations.iter().filter(|o| o.point == id).count();
    let lone: Vec<String> = project.points.iter().filter(|p| rays(&p.id) < 3).map(|p| p.id.clone()).collect();
    project.points.retain(|p| !lone.contains(&p.id));
    project.observations.retain(|o| !lone.contains(&o.point));
    project
}

/// Rms distance of the adjusted targets from their true places.
fn off(project: &Project) -> (f64, Adjustment) {
    let adjustment = adjust(project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    let square = |point: &AdjustedPoint| {
        let truth = project.points.iter().find(|p| p.id == point.id).and_then(|p| p.xyz).expect("known");
        (Vector3::from(point.xyz) - Vector3::from(truth)).norm_squared()
    };
    let targets: Vec<f64> = adjustment.points.iter().filter(|p| !p.id.starts_with('r')).map(square).collect();
    ((targets.iter().sum::<f64>() / targets.len() as f64).sqrt(), adjustment)
}

#[test]
fn a_stated_diameter_never_makes_the_object_worse() {
    let surfaces: [(&str, Targets, bool); 9] = [
        ("dome of 60", dome(60), true),
        ("dome of 150", dome(150), true),
        ("dome of 300", dome(300), true),
        ("cylinder of 64", cylinder(64), true),
        ("cylinder of 225", cylinder(225), true),
        ("saddle of 100", saddle(100), true),
        ("box of 60", cube(60), false),
        ("box of 200", cube(200), false),
        ("cloud of 100", cloud(100), false),
    ];
    for (name, targets, smooth) in &surfaces {
        let project = seen(targets, 7);
        let mut unstated = project.clone();
        unstated.points.iter_mut().for_each(|point| point.diameter = None);
        let (plain, without) = off(&unstated);
        let (stated, with) = off(&project);
        let corrected = with.eccentricity.iter().filter(|e| e.correction_px.is_some()).count();
        println!(
            "{name}: {plain:.4} mm, stated {stated:.4} mm; sigma0 {:.3}, {:.3}; corrected {corrected} of {}",
            without.sigma0.expect("redundant"),
            with.sigma0.expect("redundant"),
            with.eccentricity.len()
        );
        assert!(stated <= 1.02 * plain, "{name}: {stated} with, {plain} without the diameter");
        assert!(corrected == 0 || corrected == with.eccentricity.len(), "{name}: {corrected}");
        if *smooth {
            assert!(stated < 0.5 * plain, "{name}: {stated} with, {plain} without the diameter");
        }
    }
}
