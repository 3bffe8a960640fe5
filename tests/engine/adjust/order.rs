//! The order of a document's lists has no meaning: whatever is permuted, every standard error stays, and the covariance of all points
//! has them on its diagonal.

use std::collections::BTreeMap;

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Given};
use sightline::noise::Noise;
use sightline::project::{Camera, DatumKind, Feature, FeatureKind, Parameter, Project, Role};

use crate::support::extent;
use crate::support::networks::{Uniform, Wanted, brown, exact, noisy, opencv};

/// Smaller differences are due to the order of the computation.
const SAME: f64 = 1e-6;

fn whole(random: &mut Uniform, low: usize, high: usize) -> usize {
    random.between(low as f64, high as f64 + 1.0 - 1e-9) as usize
}

fn chance(random: &mut Uniform, share: f64) -> bool {
    random.between(0.0, 1.0) < share
}

fn shuffle<T>(list: &mut [T], random: &mut Uniform) {
    for k in (1..list.len()).rev() {
        list.swap(k, whole(random, 0, k));
    }
}

/// A camera with as much of it free as so many photos determine, some of it observed, one for all photos or one a photo.
fn camera(random: &mut Uniform, id: usize) -> Camera {
    use Parameter as P;
    let mut camera = if chance(random, 0.7) {
        let free = [&[][..], &[P::C], &[P::C, P::X0, P::Y0], &[P::C, P::X0, P::Y0, P::K1, P::P1]];
        brown(free[whole(random, 0, 3)])
    } else {
        let free = [&[][..], &[P::F], &[P::Fx, P::Fy, P::K1]];
        opencv(free[whole(random, 0, 2)])
    };
    if camera.free == [P::C, P::X0, P::Y0] && chance(random, 0.5) {
        camera.free = vec![P::X0, P::Y0];
        camera.sigma = [(P::C, 0.02)].into();
    }
    camera.per_photo = camera.free == [P::C] && chance(random, 0.3);
    camera.id = format!("k{id}");
    camera
}

/// A network of any size, datum and camera; the names of its datum points in any order.
fn network(seed: u64) -> Project {
    let random = &mut Uniform(seed);
    let points = whole(random, 12, 40);
    let cameras = whole(random, 1, 3);
    let cameras: Vec<Camera> = (0..cameras).map(|k| camera(random, k)).collect();
    let datum = [DatumKind::Free, DatumKind::Free, DatumKind::Minimal, DatumKind::Control][whole(random, 0, 3)];
    let mut names: Vec<String> = (0..points).map(|k| format!("p{k}")).collect();
    shuffle(&mut names, random);
    names.truncate(whole(random, 4, points - 1));
    let subset = datum != DatumKind::Control && chance(random, 0.7);
    let control = if datum == DatumKind::Control { whole(random, 4, 9) } else { 0 };
    let wanted = Wanted {
        photos: whole(random, 5, 9),
        points,
        cameras,
        datum,
        datum_points: subset.then_some(names),
        control: (control, if chance(random, 0.3) { 0.0 } else { 0.05 }),
        distances: (if chance(random, 0.5) { whole(random, 1, 3) } else { 0 }, 0.05),
        centre_sigma: if chance(random, 0.3) { 0.5 } else { 0.0 },
        ..Wanted::default()
    };
    let mut project = noisy(&exact(&wanted, seed), &mut Noise::new(seed, 1));
    // Some rays are missing, and some of what is given is compared only.
    project.observations.retain(|_| !chance(random, 0.1));
    if project.distances.len() > 1 {
        project.distances[1].check = true;
    }
    let plane = FeatureKind::Plane { points: (0..6).map(|k| format!("p{k}")).collect() };
    project.features = vec![Feature { id: "plane".into(), kind: plane }];
    project
}

fn permuted(project: &Project, random: &mut Uniform) -> Project {
    let mut other = project.clone();
    shuffle(&mut other.points, random);
    shuffle(&mut other.photos, random);
    shuffle(&mut other.cameras, random);
    shuffle(&mut other.observations, random);
    shuffle(&mut other.distances, random);
    if let Some(names) = &mut other.datum.points {
        shuffle(names, random);
    }
    other
}

fn adjusted(project: &Project, random: &mut Uniform) -> Result<Adjustment, sightline::Error> {
    let mut covariance_of: Vec<String> = project.points.iter().map(|p| p.id.clone()).collect();
    shuffle(&mut covariance_of, random);
    adjust(project, &AdjustOptions { covariance_of, ..AdjustOptions::default() }, &mut |_| true)
}

/// Every standard error, covariance, redundancy number, detectable bias and effect by its name.
fn figures(a: &Adjustment) -> BTreeMap<String, f64> {
    let mut all = BTreeMap::new();
    let mut add = |name: String, value: Option<f64>| {
        if let Some(value) = value {
            assert!(all.insert(name.clone(), value).is_none(), "{name} twice");
        }
    };
    add("sigma0".into(), a.sigma0);
    for p in &a.points {
        for axis in 0..3 {
            add(format!("point {} {axis}", p.id), p.sigma.map(|s| s[axis]));
        }
    }
    for p in &a.photos {
        for axis in 0..3 {
            add(format!("centre {} {axis}", p.id), p.sigma_position.map(|s| s[axis]));
            add(format!("angle {} {axis}", p.id), p.sigma_rotation.map(|s| s[axis]));
        }
    }
    for c in &a.cameras {
        for (parameter, sigma) in &c.sigma {
            add(format!("camera {} {:?} {parameter:?}", c.camera.id, c.photo), Some(*sigma));
        }
    }
    for o in &a.observations {
        let name = format!("ray {} {}", o.photo, o.point);
        let values = [o.rx, o.ry, o.mdb_x, o.mdb_y, o.effect_x, o.effect_y];
        values.into_iter().enumerate().for_each(|(k, value)| add(format!("{name} {k}"), value));
    }
    for g in &a.given {
        let name = match &g.what {
            Given::Parameter { camera, photo, parameter } => format!("{camera} {photo:?} {parameter:?}"),
            other => format!("{other:?}"),
        };
        add(format!("{name} redundancy"), g.reliability.map(|r| r.redundancy));
        add(format!("{name} mdb"), g.reliability.and_then(|r| r.mdb));
        add(format!("{name} effect"), g.effect);
    }
    for d in &a.check_distances {
        add(format!("check {} {}", d.from, d.to), d.sigma);
    }
    for f in &a.features {
        add(format!("{} direction", f.id), f.sigma_direction);
        (0..3).for_each(|axis| add(format!("{} {axis}", f.id), f.sigma_position.map(|s| s[axis])));
    }
    if let Some(c) = &a.covariance {
        let variances = c.matrix.iter().enumerate().map(|(k, row)| row[k]);
        add("largest variance".into(), variances.reduce(f64::max));
        for (i, row) in c.matrix.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                add(format!("covariance {} {} {} {}", c.points[i / 3], i % 3, c.points[j / 3], j % 3), Some(*value));
            }
        }
    }
    all
}

/// Rounding of a covariance is that of the variances beside it; of a redundancy number, that of 1.
fn scale(name: &str, all: &BTreeMap<String, f64>) -> f64 {
    let parts: Vec<&str> = name.split(' ').collect();
    match parts[..] {
        ["covariance", p, i, q, j] => {
            let variance = |p: &str, i: &str| all[&format!("covariance {p} {i} {p} {i}")].max(0.0);
            // Of what is held, whose variance is 0, it is what the S-transformation leaves of the largest: some 1e-13 of it.
            (variance(p, i) * variance(q, j)).sqrt().max(1e-6 * all["largest variance"])
        }
        ["ray", _, _, "0" | "1"] | [.., "redundancy"] => 1.0,
        // What is held is moved by nothing, but for rounding.
        ["ray", _, _, "4" | "5"] | [.., "effect"] => all[name].max(1e-4 * all["largest variance"].sqrt()),
        _ => all[name].abs().max(1e-9),
    }
}

fn assert_same(a: &BTreeMap<String, f64>, b: &BTreeMap<String, f64>, what: &str) {
    assert!(a.keys().eq(b.keys()), "{what}: other figures");
    for (name, value) in a {
        let difference = (b[name] - value).abs() / scale(name, a);
        assert!(difference < SAME, "{what}, {name}: {value}, {}", b[name]);
    }
}

#[test]
fn no_order_of_any_list_changes_a_standard_error() {
    let (mut solved, mut kinds) = (0, BTreeMap::<String, usize>::new());
    for seed in 0..extent::cases(15, 60) as u64 {
        let project = network(9000 + seed);
        let random = &mut Uniform(77 + seed);
        let Ok(first) = adjusted(&project, random) else { continue };
        solved += 1;
        *kinds.entry(format!("{:?} {}", project.datum.kind, project.datum.points.is_some())).or_default() += 1;
        let first = figures(&first);
        for p in project.points.iter().filter(|p| p.role != Role::Check) {
            for axis in 0..3 {
                let sigma = first[&format!("point {} {axis}", p.id)];
                let variance = first[&format!("covariance {} {axis} {} {axis}", p.id, p.id)];
                let own = variance.max(0.0).sqrt();
                assert!((own - sigma).abs() <= SAME * sigma.max(1e-9), "{seed}, {} {axis}: {sigma}, {own}", p.id);
            }
        }
        for copy in 0..3 {
            let other = adjusted(&permuted(&project, random), random).expect("solvable in its first order");
            assert_same(&first, &figures(&other), &format!("network {seed}, copy {copy}"));
        }
    }
    println!("{solved} networks: {kinds:?}");
    assert!(solved >= extent::cases(13, 54) && kinds.len() >= 4, "{solved}: {kinds:?}");
}

/// On a grid many points are as far from each other: which of them hold a minimal datum is not for their order to say.
#[test]
fn a_minimal_datum_on_a_grid_is_the_same_in_any_order() {
    for seed in 0..12 {
        let random = &mut Uniform(400 + seed);
        let wanted = Wanted { points: 25, datum: DatumKind::Minimal, sigma_px: 0.1, ..Wanted::default() };
        let mut project = exact(&wanted, seed);
        let pitch = random.between(50.0, 150.0);
        let cameras = project.cameras.clone();
        let turn = if chance(random, 0.5) { random.between(0.0, 1.0) } else { 0.0 };
        for (k, point) in project.points.iter_mut().enumerate() {
            let (x, y) = (((k % 5) as f64 - 2.0) * pitch, ((k / 5) as f64 - 2.0) * pitch);
            point.xyz = Some([x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos(), 20.0]);
        }
        for o in &mut project.observations {
            let photo = project.photos.iter().find(|p| p.id == o.photo).expect("there");
            let point = project.points.iter().find(|p| p.id == o.point).and_then(|p| p.xyz).expect("there");
            let m = sightline::rotation::object_to_camera(photo.rotation.expect("oriented"));
            let v = nalgebra::Vector3::from(point) - nalgebra::Vector3::from(photo.position.expect("oriented"));
            [o.u, o.v] = sightline::camera::pixel_from_camera_point(&cameras[0], m * v).expect("in front");
        }
        // The camera of a plane is held.
        project.cameras[0].free.clear();
        let project = noisy(&project, &mut Noise::new(seed, 3));
        let first = figures(&adjusted(&project, random).expect("solvable"));
        let held = first.iter().filter(|(name, value)| name.starts_with("point") && **value == 0.0).count();
        assert_eq!(held, 7);
        for copy in 0..4 {
            let other = adjusted(&permuted(&project, random), random).expect("solvable");
            assert_same(&first, &figures(&other), &format!("grid {seed}, copy {copy}"));
        }
    }
}
