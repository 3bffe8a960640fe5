//! A network measured in red with a lens that images red otherwise than green: with the camera's set for red it is as good as in green.

use std::f64::consts::PI;

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::camera::colour_differences;
use sightline::noise::Noise;
use sightline::orient::orient;
use sightline::project::{Camera, ColourShift, LensColour, PhotoColours, Project};

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
        points: 40,
        cameras: vec![camera],
        distances: (4, 0.01),
        sigma_px: 0.05,
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
