//! Planted gross errors: what data snooping and robust weights do with them, and what the record says.

use crate::support::networks::{Wanted, brown, exact, noisy};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Given, GrossErrorAction, Robust, Termination};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project};

const PLANTED: [(usize, f64); 5] = [(3, 5.0), (20, -3.0), (41, 40.0), (60, 2.5), (77, -8.0)];

fn spoiled() -> (Project, Project) {
    let wanted = Wanted { photos: 8, points: 20, ..Wanted::default() };
    let clean = noisy(&exact(&wanted, 7), &mut Noise::new(7, 0));
    let mut spoiled = clean.clone();
    for (row, pixels) in PLANTED {
        spoiled.observations[row].u += pixels;
    }
    (clean, spoiled)
}

fn run(project: &Project, options: AdjustOptions) -> Adjustment {
    let adjustment = adjust(project, &options, &mut |_| true).expect("solvable");
    assert_eq!(adjustment.termination, Termination::Converged);
    adjustment
}

#[test]
fn snooping_takes_out_what_was_planted() {
    let (mut clean, spoiled) = spoiled();
    let found = run(&spoiled, AdjustOptions { snooping: true, ..AdjustOptions::default() });
    let out: Vec<usize> = (0..spoiled.observations.len()).filter(|k| !found.observations[*k].enabled).collect();
    assert!(PLANTED.iter().all(|(row, _)| out.contains(row)), "{out:?}");
    // At 0.1 % one false alarm among 320 tests is to be expected now and then.
    assert!(out.len() <= PLANTED.len() + 1, "{out:?}");
    assert!(found.gross_errors.iter().all(|g| g.round >= 1 && g.statistic != 0.0));
    let removed = found.gross_errors.iter().filter(|g| g.action == GrossErrorAction::Removed).count();
    let restored = found.gross_errors.iter().filter(|g| g.action == GrossErrorAction::Restored).count();
    assert_eq!(removed - restored, out.len());
    // The largest error goes first.
    let first = &found.gross_errors[0];
    assert_eq!((&first.photo, &first.point), (&spoiled.observations[41].photo, &spoiled.observations[41].point));
    // The same as if the observations had never been there.
    out.iter().for_each(|row| clean.observations[*row].enabled = false);
    let expected = run(&clean, AdjustOptions::default());
    assert_eq!(found.redundancy, expected.redundancy);
    assert!((found.sigma0.expect("redundant") - expected.sigma0.expect("redundant")).abs() < 1e-9);
}

#[test]
fn robust_weights_leave_little_of_planted_errors() {
    let (clean, spoiled) = spoiled();
    let plain = run(&spoiled, AdjustOptions::default());
    let truth = run(&clean, AdjustOptions::default());
    let error = |adjustment: &Adjustment| {
        let pairs = adjustment.points.iter().zip(&truth.points);
        pairs.flat_map(|(a, b)| (0..3).map(move |k| (a.xyz[k] - b.xyz[k]).abs())).fold(0.0, f64::max)
    };
    for kind in [Robust::Huber, Robust::Tukey] {
        let robust = run(&spoiled, AdjustOptions { robust: Some(kind), ..AdjustOptions::default() });
        assert!(error(&robust) < 0.2 * error(&plain), "{kind:?}: {} against {}", error(&robust), error(&plain));
        for (row, _) in PLANTED {
            assert!(robust.observations[row].weight.is_some_and(|w| w < 0.5), "{row} keeps its weight");
        }
        assert!(robust.gross_errors.iter().all(|g| g.action == GrossErrorAction::Downweighted));
        assert!(robust.gross_errors.len() >= PLANTED.len());
    }
}

/// A controlled network with observations of every kind.
fn controlled() -> Project {
    let mut camera = brown(&[Parameter::K1]);
    camera.sigma = [(Parameter::C, 0.01), (Parameter::X0, 0.01)].into();
    let wanted = Wanted {
        photos: 8,
        points: 20,
        cameras: vec![camera],
        datum: DatumKind::Control,
        control: (6, 0.1),
        distances: (8, 0.1),
        centre_sigma: 0.5,
        ..Wanted::default()
    };
    noisy(&exact(&wanted, 53), &mut Noise::new(53, 0))
}

/// A gross error of one kind: what it is called, how it is planted, and its size in the observation's unit.
type Plant = (Given, fn(&mut Project), f64);

fn plants() -> [Plant; 4] {
    [
        (Given::Control { point: "p3".into(), axis: 1 }, |p| p.points[3].xyz.as_mut().unwrap()[1] += 2.0, 2.0),
        (Given::Position { photo: "f5".into(), axis: 2 }, |p| p.photos[5].position.as_mut().unwrap()[2] -= 9.0, -9.0),
        (Given::Distance { from: "p8".into(), to: "p9".into() }, |p| p.distances[4].length += 2.5, 2.5),
        (
            Given::Parameter { camera: "brown".into(), photo: None, parameter: Parameter::C },
            |p| p.cameras[0].interior.set(Parameter::C, 20.0 - 0.3),
            -0.3,
        ),
    ]
}

/// The planted observation is out, its residual tells the error, and the result is as if it had never been there.
fn taken_out(found: &Adjustment, what: &Given, size: f64) {
    let row = found.given.iter().find(|g| g.what == *what).expect("listed");
    assert!(!row.enabled && row.reliability.is_none() && row.effect.is_none(), "{row:?}");
    let residual = row.residual.expect("beside the adjusted value");
    assert!((residual + size).abs() < 0.3 * size.abs(), "{what:?} of {size} leaves {residual}");
}

#[test]
fn snooping_finds_a_planted_error_of_every_kind_by_name() {
    let clean = run(&controlled(), AdjustOptions { snooping: true, ..AdjustOptions::default() });
    for (what, plant, size) in plants() {
        let mut spoiled = controlled();
        plant(&mut spoiled);
        let found = run(&spoiled, AdjustOptions { snooping: true, ..AdjustOptions::default() });
        let first = found.gross_errors.first().expect("something is found");
        assert_eq!(first.given.as_ref(), Some(&what), "{:?}", found.gross_errors);
        assert_eq!((first.action, first.consequence), (GrossErrorAction::Removed, false));
        assert!(first.statistic > first.limit);
        taken_out(&found, &what, size);
        assert!(found.gross_errors.len() <= clean.gross_errors.len() + 2, "{:?}", found.gross_errors);
        assert_eq!(found.given.iter().filter(|g| g.what == what).count(), 1);
        // The unspoiled value changes nothing where it is left out too.
        for (a, b) in found.points.iter().zip(&clean.points) {
            let sigma = b.sigma.expect("full");
            assert!((0..3).all(|k| (a.xyz[k] - b.xyz[k]).abs() < 4.0 * sigma[k]), "{a:?} {b:?}");
        }
    }
}

#[test]
fn snooping_finds_planted_errors_of_all_kinds_at_once() {
    let mut spoiled = controlled();
    plants().iter().for_each(|(_, plant, _)| plant(&mut spoiled));
    spoiled.observations[41].u += 6.0;
    let found = run(&spoiled, AdjustOptions { snooping: true, ..AdjustOptions::default() });
    plants().iter().for_each(|(what, _, size)| taken_out(&found, what, *size));
    assert!(!found.observations[41].enabled);
    let removed = |action| found.gross_errors.iter().filter(|g| g.action == action).count();
    let out =
        found.given.iter().filter(|g| !g.enabled).count() + found.observations.iter().filter(|o| !o.enabled).count();
    assert_eq!(removed(GrossErrorAction::Removed) - removed(GrossErrorAction::Restored), out);
    // 4 + 1 planted, and now and then a false alarm among 200 tests.
    assert!(out <= 7, "{:?}", found.gross_errors);
    // The same as without the distance and the ray from the start; what is out has no part in the redundancy.
    let numbers = found.observations.iter().flat_map(|o| [o.rx, o.ry]).flatten().sum::<f64>()
        + found.given.iter().filter_map(|g| g.reliability).map(|r| r.redundancy).sum::<f64>();
    assert!((numbers - found.redundancy as f64).abs() < 1e-6, "{numbers} {}", found.redundancy);
    assert!(found.sigma0.is_some_and(|s| (0.8..1.2).contains(&s)), "{:?}", found.sigma0);
}

#[test]
fn a_distance_taken_out_is_as_if_it_had_never_been_measured() {
    let mut spoiled = controlled();
    spoiled.distances[4].length += 2.5;
    let found = run(&spoiled, AdjustOptions { snooping: true, ..AdjustOptions::default() });
    let mut without = spoiled.clone();
    without.distances.remove(4);
    let expected = run(&without, AdjustOptions { snooping: true, ..AdjustOptions::default() });
    assert_eq!(found.redundancy, expected.redundancy);
    assert!((found.sigma0.expect("redundant") - expected.sigma0.expect("redundant")).abs() < 1e-9);
    assert!(!found.advice.iter().any(|a| matches!(a, sightline::adjustment::Advice::DistanceUnused { .. })));
}

#[test]
fn robust_weights_lower_a_planted_error_of_every_kind() {
    let truth = run(&controlled(), AdjustOptions::default());
    // What the planted error alone changes, by either way of adjusting.
    let change = |spoiled: &Adjustment, clean: &Adjustment| {
        let pairs = spoiled.points.iter().zip(&clean.points);
        pairs.flat_map(|(a, b)| (0..3).map(move |k| (a.xyz[k] - b.xyz[k]).abs())).fold(0.0, f64::max)
    };
    for (what, plant, _) in plants() {
        let mut spoiled = controlled();
        plant(&mut spoiled);
        for kind in [Robust::Huber, Robust::Tukey] {
            let robust = run(&spoiled, AdjustOptions { robust: Some(kind), ..AdjustOptions::default() });
            let entry = robust.gross_errors.iter().find(|g| g.given.as_ref() == Some(&what)).expect("in the record");
            assert_eq!((entry.action, entry.limit), (GrossErrorAction::Downweighted, 0.5));
            let row = robust.given.iter().find(|g| g.what == what).expect("listed");
            assert!(row.enabled && row.weight.is_some_and(|w| w < 0.5 && w == entry.statistic), "{row:?}");
            let original = truth.given.iter().find(|g| g.what == what).expect("listed");
            assert!((row.sigma / original.sigma - 1.0).abs() < 1e-9, "{} {}", row.sigma, original.sigma);
            let clean = run(&controlled(), AdjustOptions { robust: Some(kind), ..AdjustOptions::default() });
            let robust = change(&robust, &clean);
            let plain = change(&run(&spoiled, AdjustOptions::default()), &truth);
            let part = if kind == Robust::Tukey { 0.2 } else { 0.6 };
            assert!(robust < part * plain, "{what:?} {kind:?}: {robust} of {plain}");
        }
    }
}
