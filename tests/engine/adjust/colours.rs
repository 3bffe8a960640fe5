//! A network measured in red with a lens that images red otherwise than green: with the camera's set for red it is as good as in green, and
//! its coordinates are the true ones.

use std::f64::consts::PI;

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::camera::colour_differences;
use sightline::noise::Noise;
use sightline::orient::orient;
use sightline::project::{
    Camera, ColourDifferences, ColourShift, DatumKind, LensColour, Parameter, PhotoColours, Project, Role,
};

use crate::support::networks::{Wanted, brown, exact, noisy, opencv};

const CENTRE: [f64; 2] = [2000.0, 1500.0];
const CORNER: f64 = 2500.0;
/// Shift in u and v, linear and cubic part at the corner, pixels.
const X: [f64; 4] = [0.1, -0.05, 1.8, -1.2];

/// Where red stands of a target that stands here in green.
fn red([u, v]: [f64; 2]) -> [f64; 2] {
    let [x, y] = [(u - CENTRE[0]) / CORNER, (v - CENTRE[1]) / CORNER];
    let grown = X[2] + X[3] * (x * x + y * y);
    [u + X[0] + grown * x, v + X[1] + grown * y]
}

/// What detection tells of this lens.
fn measured() -> PhotoColours {
    let mut covariance = [0.0; 10];
    for k in [0, 4, 7, 9] {
        covariance[k] = 1e-4;
    }
    let shift = ColourShift {
        linear: X[2],
        cubic: X[3],
        shift: Some([X[0], X[1]]),
        covariance: Some(covariance),
        ..ColourShift::default()
    };
    PhotoColours { photo: "f0".into(), corner: CORNER, centre: Some(CENTRE), red: Some(shift), blue: None }
}

/// The same measurements in green and, every other photo, in red.
fn in_green_and_red(camera: Camera) -> (Project, Project) {
    let wanted = Wanted {
        photos: 8,
        points: 60,
        cameras: vec![camera],
        distances: (4, 0.01),
        sigma_px: 0.05,
        wide: true,
        ..Wanted::default()
    };
    let green = noisy(&exact(&wanted, 31), &mut Noise::new(31, 0));
    let mut mixed = green.clone();
    for (k, photo) in mixed.photos.iter_mut().enumerate() {
        photo.colour = (k % 2 == 0).then_some(LensColour::Red);
    }
    for o in &mut mixed.observations {
        if mixed.photos.iter().any(|p| p.id == o.photo && p.colour.is_some()) {
            [o.u, o.v] = red([o.u, o.v]);
        }
    }
    (green, mixed)
}

fn with_set(project: &Project) -> Project {
    let mut project = project.clone();
    project.cameras[0].colours = colour_differences(&project.cameras[0], &[measured()]).expect("a set");
    project
}

fn solve(project: &Project) -> Adjustment {
    adjust(project, &AdjustOptions::default(), &mut |_| true).expect("solvable")
}

/// Largest difference of a coordinate, in its standard errors.
fn apart(a: &Adjustment, b: &Adjustment) -> f64 {
    let one = |k: usize, axis: usize| {
        let (a, b) = (&a.points[k], &b.points[k]);
        assert_eq!(a.id, b.id);
        (a.xyz[axis] - b.xyz[axis]).abs() / a.sigma.expect("a sigma")[axis]
    };
    (0..a.points.len()).flat_map(|k| [one(k, 0), one(k, 1), one(k, 2)]).fold(0.0, f64::max)
}

#[test]
fn with_its_set_red_is_as_good_as_green() {
    for camera in [brown(&[]), opencv(&[])] {
        let (green, mixed) = in_green_and_red(camera);
        let wanted = solve(&green);
        let found = solve(&with_set(&mixed));
        let sigma0 = |a: &Adjustment| a.sigma0.expect("redundant");
        assert!((sigma0(&found) / sigma0(&wanted) - 1.0).abs() < 0.01, "{} {}", sigma0(&found), sigma0(&wanted));
        assert!(apart(&wanted, &found) < 0.1, "{}", apart(&wanted, &found));
        // without the set the photos contradict each other
        let without = solve(&mixed);
        assert!(sigma0(&without) > 2.0 * sigma0(&wanted), "{}", sigma0(&without));
        assert!(apart(&wanted, &without) > 1.0, "{}", apart(&wanted, &without));
    }
}

/// A camera that calibrates itself from photos of both colours: its own parameters are those of green, the set is kept.
#[test]
fn what_is_estimated_is_the_own_colours() {
    let model = brown(&[]);
    let free = &model.interior.parameters()[..5];
    let (green, mixed) = in_green_and_red(brown(free));
    let (wanted, found) = (solve(&green), solve(&with_set(&mixed)));
    for p in free {
        let of = |a: &Adjustment| a.cameras[0].camera.interior.get(*p).expect("a value");
        let sigma = wanted.cameras[0].sigma[p];
        assert!((of(&found) - of(&wanted)).abs() < 0.1 * sigma, "{p}: {} {} {sigma}", of(&found), of(&wanted));
    }
    assert_eq!(found.cameras[0].camera.colours, with_set(&mixed).cameras[0].colours);
}

#[test]
fn orientation_sees_the_colour_too() {
    let (_, mixed) = in_green_and_red(brown(&[]));
    let mut lost = with_set(&mixed);
    lost.photos.iter_mut().for_each(|photo| (photo.position, photo.rotation) = (None, None));
    lost.points.iter_mut().for_each(|point| point.xyz = None);
    let oriented = orient(&lost).expect("oriented").project;
    assert!(oriented.photos.iter().all(|p| p.position.is_some()));
    let (found, wanted) = (solve(&oriented), solve(&with_set(&mixed)));
    assert!((found.sigma0.expect("r") / wanted.sigma0.expect("r") - 1.0).abs() < 1e-4);
    assert!(oriented.photos.iter().all(|p| p.rotation.is_some_and(|r| r.iter().all(|a| a.abs() <= PI))));
}

/// What a lens changes for red, in the units of either model: two pixels at the corner linear in the radius, one against or with its third power.
fn changed(camera: &Camera) -> Vec<(Parameter, f64)> {
    use Parameter as P;
    match camera.interior.get(P::C) {
        Some(_) => vec![(P::C, 0.016), (P::X0, 5e-4), (P::Y0, -3e-4), (P::K1, 3e-6), (P::P1, 2e-7)],
        None => vec![(P::Fx, 3.2), (P::Fy, 3.2), (P::Cx, 0.1), (P::Cy, 0.06), (P::K1, -1.5e-3), (P::P2, 1e-5)],
    }
}

/// A network whose second, fourth ... photo was taken by the lens as it images red: a camera of its own in the simulation, the first camera in
/// that colour afterwards. The truth, and what was measured of it.
fn simulated(green: &Camera, seed: u64) -> (Project, Project) {
    let mut red = Camera { id: "red".into(), ..green.clone() };
    for (p, difference) in changed(green) {
        red.interior.set(p, green.interior.get(p).expect("a value") + difference);
    }
    let wanted = Wanted {
        photos: 8,
        points: 60,
        cameras: vec![green.clone(), red],
        datum: DatumKind::Control,
        control: (8, 0.02),
        sigma_px: 0.05,
        wide: true,
        ..Wanted::default()
    };
    let truth = exact(&wanted, seed);
    let mut measured = noisy(&truth, &mut Noise::new(seed, 1));
    measured.cameras.truncate(1);
    for photo in measured.photos.iter_mut().filter(|photo| photo.camera == "red") {
        photo.camera.clone_from(&green.id);
        photo.colour = Some(LensColour::Red);
    }
    (truth, measured)
}

/// Mean square of the new points' errors in standard errors: those of a right adjustment.
fn errors(truth: &Project, found: &Adjustment, right: &Adjustment) -> f64 {
    let new = truth.points.iter().zip(found.points.iter().zip(&right.points)).filter(|(p, _)| p.role == Role::Tie);
    let squares: Vec<f64> = new
        .flat_map(|(point, (adjusted, right))| {
            assert_eq!([&point.id; 2], [&adjusted.id, &right.id]);
            let (xyz, sigma) = (point.xyz.expect("known"), right.sigma.expect("a sigma"));
            (0..3).map(move |a| ((adjusted.xyz[a] - xyz[a]) / sigma[a]).powi(2))
        })
        .collect();
    squares.iter().sum::<f64>() / squares.len() as f64
}

#[test]
fn coordinates_are_true_with_the_sets_and_wrong_without() {
    use Parameter as P;
    let free = [P::C, P::X0, P::Y0, P::K1, P::K2, P::K3, P::P1, P::P2];
    let free_too = [P::Fx, P::Fy, P::Cx, P::Cy, P::K1, P::K2, P::P1, P::P2];
    for camera in [brown(&free), opencv(&free_too), brown(&[]), opencv(&[])] {
        const RUNS: u64 = 20;
        let (mut with, mut without, mut variance) = (0.0, 0.0, 0.0);
        for seed in 0..RUNS {
            let (truth, measured) = simulated(&camera, 100 + seed);
            let mut known = measured.clone();
            let set = ColourDifferences { parameters: changed(&camera).into_iter().collect(), ..Default::default() };
            known.cameras[0].colours.insert(LensColour::Red, set);
            let found = solve(&known);
            with += errors(&truth, &found, &found) / RUNS as f64;
            variance += found.sigma0.expect("redundant").powi(2) / RUNS as f64;
            let wrong = solve(&measured);
            without += errors(&truth, &wrong, &found) / RUNS as f64;
            // the photos contradict each other, by far more than they were measured to
            assert!(wrong.sigma0.expect("redundant") > 1.5, "{}: {:?}", camera.id, wrong.sigma0);
        }
        assert!((0.95..1.05).contains(&variance.sqrt()), "{}: {}", camera.id, variance.sqrt());
        assert!((0.9..1.1).contains(&with.sqrt()), "{}: {}", camera.id, with.sqrt());
        assert!(without > 1.5 * with, "{}: {} {}", camera.id, without.sqrt(), with.sqrt());
    }
}

/// What a camera has no set of is imaged as everything was before there were sets.
#[test]
fn a_colour_without_a_set_changes_nothing() {
    for camera in [brown(&[Parameter::C, Parameter::K1]), opencv(&[Parameter::F])] {
        let (_, mut measured) = simulated(&camera, 7);
        let set = ColourDifferences { parameters: changed(&camera).into_iter().collect(), ..Default::default() };
        measured.cameras[0].colours.insert(LensColour::Blue, set);
        let mut before = measured.clone();
        before.photos.iter_mut().for_each(|photo| photo.colour = None);
        before.cameras[0].colours.clear();
        let (mut found, wanted) = (solve(&measured), solve(&before));
        found.cameras[0].camera.colours.clear();
        assert_eq!(found, wanted);
        // and orientation finds the same, too
        let lost = |project: &Project| {
            let mut lost = project.clone();
            lost.photos.iter_mut().for_each(|photo| (photo.position, photo.rotation) = (None, None));
            lost.points.iter_mut().filter(|p| p.role == Role::Tie).for_each(|point| point.xyz = None);
            orient(&lost).expect("oriented").project
        };
        let (found, wanted) = (lost(&measured), lost(&before));
        for (a, b) in found.photos.iter().zip(&wanted.photos) {
            assert_eq!((a.position, a.rotation), (b.position, b.rotation));
        }
    }
}
