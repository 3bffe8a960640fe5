//! What the field brings: cameras that the photos leave open, slips of digits in coordinates and standard errors. The right thing is
//! named, and what can be solved is solved.

use crate::support::networks::{Wanted, brown, exact, noisy};
use nalgebra::Vector3;
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Advice, Given, Termination};
use sightline::camera::pixel_from_camera_point;
use sightline::error::{Defect, Error, Place, Reason};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project, Sigma};
use sightline::rotation;

fn run(project: &Project, snooping: bool) -> Result<Adjustment, Error> {
    adjust(project, &AdjustOptions { snooping, ..AdjustOptions::default() }, &mut |_| true)
}

/// Six photos that look down on the ground under angles of about `tilt`.
fn from_above(tilt: f64, plane: bool, control: bool, seed: u64) -> Project {
    let wanted = Wanted {
        points: 30,
        cameras: vec![brown(&[Parameter::C])],
        datum: if control { DatumKind::Control } else { DatumKind::Free },
        control: if control { (10, 1.0) } else { (0, 0.0) },
        sigma_px: 0.1,
        ..Wanted::default()
    };
    let mut project = exact(&wanted, seed);
    for (k, photo) in project.photos.iter_mut().enumerate() {
        photo.position = Some([200.0 * (k % 3) as f64 - 200.0, 200.0 * (k / 3) as f64 - 100.0, 1500.0]);
        photo.rotation = Some([tilt * (k as f64 * 1.3).sin(), tilt * (k as f64 * 2.1).cos(), 1.57 * (k % 4) as f64]);
    }
    if plane {
        project.points.iter_mut().for_each(|p| p.xyz = p.xyz.map(|[x, y, _]| [x, y, 0.0]));
    }
    for o in &mut project.observations {
        let photo = project.photos.iter().find(|p| p.id == o.photo).expect("known");
        let point = project.points.iter().find(|p| p.id == o.point).expect("known");
        let d = Vector3::from(point.xyz.expect("known")) - Vector3::from(photo.position.expect("known"));
        let d = rotation::object_to_camera(photo.rotation.expect("known")) * d;
        [o.u, o.v] = pixel_from_camera_point(&project.cameras[0], d).expect("in front");
    }
    noisy(&project, &mut Noise::new(seed, 0))
}

#[test]
fn a_principal_distance_that_the_photos_leave_open_is_told() {
    let weak = |found: &Adjustment| {
        let told = |a: &&Advice| matches!(a, Advice::WeakPrincipalDistance { camera, .. } if camera == "brown");
        found.advice.iter().filter(told).count()
    };
    for seed in 1..4 {
        // Parallel photos over relief, and over a plane with control.
        for open in [from_above(0.0, false, false, seed), from_above(0.0, true, true, seed)] {
            for snooping in [false, true] {
                assert_eq!(weak(&run(&open, snooping).expect("a result")), 1, "{seed}");
            }
        }
        let Err(Error::RankDefect { defects }) = run(&from_above(0.0, true, false, seed), false) else { panic!() };
        let of_c = |d: &Defect| matches!(d, Defect::ParameterUndetermined { parameters, .. } if parameters == &["c"]);
        assert!(defects.iter().any(of_c), "{defects:?}");
        for sound in [from_above(0.05, false, false, seed), from_above(0.05, true, true, seed)] {
            let found = run(&sound, false).expect("solvable");
            assert_eq!((weak(&found), found.termination), (0, Termination::Converged), "{seed}");
        }
    }
}

fn base(control: bool) -> Project {
    let wanted = Wanted {
        points: 30,
        datum: if control { DatumKind::Control } else { DatumKind::Free },
        control: if control { (10, 1.0) } else { (0, 0.0) },
        distances: (2, 0.1),
        sigma_px: 0.1,
        ..Wanted::default()
    };
    noisy(&exact(&wanted, 5), &mut Noise::new(5, 0))
}

fn sigma0(found: &Adjustment) -> f64 {
    assert_eq!(found.termination, Termination::Converged);
    found.sigma0.expect("redundant")
}

#[test]
fn a_point_far_off_stops_nothing() {
    for (control, snooping) in [(false, false), (false, true), (true, false), (true, true)] {
        let project = base(control);
        let sound = sigma0(&run(&project, snooping).expect("solvable"));
        for far in [1e4, 1e6, 1e9] {
            for place in [[far, far, -far], [0.0, 0.0, far], [-far, 0.0, 0.0]] {
                let mut slipped = project.clone();
                slipped.points[20].xyz = Some(place);
                let found = sigma0(&run(&slipped, snooping).unwrap_or_else(|e| panic!("{place:?}: {e}")));
                assert!((found / sound - 1.0).abs() < 1e-6, "{place:?}: {found} instead of {sound}");
            }
        }
    }
}

#[test]
fn gross_errors_of_any_size_are_taken_out_or_named() {
    for control in [false, true] {
        let project = base(control);
        let sound = sigma0(&run(&project, true).expect("solvable"));
        for far in [1e4, 1e6, 1e9] {
            let mut slipped = project.clone();
            let row = 40;
            slipped.observations[row].u = far;
            let (photo, point) = (&project.observations[row].photo, &project.observations[row].point);
            let found = run(&slipped, true).expect("solvable");
            assert!(!found.observations[row].enabled, "{far}: {:?}", found.gross_errors);
            assert!((sigma0(&found) / sound - 1.0).abs() < 0.05, "{far}");
            let plain = run(&slipped, false).expect("a result");
            let first = plain.advice.iter().find_map(|a| match a {
                Advice::Suspected { observations, .. } => observations.first(),
                _ => None,
            });
            assert!(first.is_some_and(|(a, b, _)| a == photo && b == point), "{far}: {first:?}");
        }
    }
}

#[test]
fn control_of_another_place_is_taken_out_or_named() {
    let project = base(true);
    let sound = sigma0(&run(&project, true).expect("solvable"));
    let what = Given::Control { point: "p5".into(), axis: 0 };
    for far in [1e3, 1e4, 1e6] {
        let mut slipped = project.clone();
        slipped.points[5].xyz = slipped.points[5].xyz.map(|[x, y, z]| [x + far, y, z]);
        let found = run(&slipped, true).expect("solvable");
        assert!(found.given.iter().any(|g| g.what == what && !g.enabled), "{far}: {:?}", found.gross_errors);
        assert!((sigma0(&found) / sound - 1.0).abs() < 0.05, "{far}");
        let plain = run(&slipped, false).expect("a result");
        let named = plain.advice.iter().any(|a| match a {
            Advice::Suspected { given, .. } => given.iter().any(|(g, _)| *g == what),
            _ => false,
        });
        assert!(named, "{far}: {:?}", plain.advice);
    }
}

#[test]
fn a_distance_far_more_accurate_than_the_images_does_not_pass_its_error_on() {
    let mut project = base(false);
    project.distances.iter_mut().for_each(|d| d.sigma = 0.01);
    project.distances[1].length += 3.0;
    let found = run(&project, true).expect("solvable");
    let what = Given::Distance { from: "p2".into(), to: "p3".into() };
    assert_eq!(found.gross_errors[0].given, Some(what), "{:?}", found.gross_errors);
    assert!(found.gross_errors.len() < 3, "{:?}", found.gross_errors);
    assert!((sigma0(&found) - 1.0).abs() < 0.1);
}

/// The place that is blamed; `None` if the network is solved, and then by what the observations say.
fn blamed(project: &Project, expected: f64) -> Option<Place> {
    match run(project, false) {
        Ok(found) => {
            let sigma0 = sigma0(&found);
            assert!(sigma0 < 2.0 * expected && sigma0 > expected / 2.0, "{sigma0} instead of {expected}");
            None
        }
        Err(Error::Invalid { reason: Reason::StandardErrorsApart { .. }, at }) => Some(at),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn a_standard_error_that_slipped_is_blamed_and_nothing_else() {
    for control in [false, true] {
        let project = base(control);
        for sigma in [1e-12, 1e-9, 1e-6, 1e-4, 1e3, 1e6, 1e9] {
            let mut one = project.clone();
            one.observations[40].sigma = Sigma::One(sigma);
            let at = blamed(&one, 1.0);
            let (photo, point) = (one.observations[40].photo.clone(), one.observations[40].point.clone());
            assert!(at.is_none_or(|at| at.photo == Some(photo) && at.point == Some(point)), "{sigma}");
            let mut of_photo = project.clone();
            let own = of_photo.observations.iter_mut().filter(|o| o.photo == "f2");
            own.for_each(|o| o.sigma = Sigma::One(sigma));
            let at = blamed(&of_photo, 1.0);
            assert!(at.is_none_or(|at| at.photo.as_deref() == Some("f2")), "{sigma}");
            let mut distance = project.clone();
            distance.distances[0].sigma = sigma;
            let at = blamed(&distance, 1.0);
            assert!(at.is_none_or(|at| at.field.as_deref() == Some("distances[0].sigma")), "{sigma}");
            if control {
                let mut all = project.clone();
                all.points.iter_mut().filter_map(|p| p.sigma.as_mut()).for_each(|s| *s = [Some(sigma); 3]);
                let expected = if sigma < 0.1 { 14.0 } else { 1.0 };
                let at = blamed(&all, expected);
                assert!(at.is_none_or(|at| at.photo.is_none() && at.field.as_deref() == Some("sigma")), "{sigma}");
            }
        }
    }
}

#[test]
fn a_photo_that_sees_none_of_its_points_is_named() {
    for control in [false, true] {
        for far in [1e6, 1e9] {
            let mut slipped = base(control);
            slipped.photos[2].position = slipped.photos[2].position.map(|[x, y, z]| [x + far, y, z]);
            match run(&slipped, false) {
                Err(Error::Invalid { reason: Reason::PhotoAstray, at }) => assert_eq!(at.photo.as_deref(), Some("f2")),
                other => panic!("{far}: {:?}", other.map(|a| a.sigma0)),
            }
        }
    }
}
