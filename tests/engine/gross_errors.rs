//! Planted gross errors: what data snooping and robust weights do with them, and what the record says.

use crate::networks::{Wanted, exact, noisy};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, GrossErrorAction, Robust, Termination};
use sightline::noise::Noise;
use sightline::project::Project;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

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
