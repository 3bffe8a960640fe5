//! Estimation that holds what it states: robust weights and snooping on clean data and with gross errors, the global test with strong
//! distortion, variance components. The bench `estimation` runs the same trials with all samples.

use crate::support::networks::{Uniform, Wanted, brown, exact, noisy};
use crate::support::trials::{clean, distorted, spoil, spoiled, trials};
use sightline::adjust::adjust;
use sightline::adjustment::{
    AdjustOptions, Adjustment, Advice, GrossErrorAction, ObservationGroup, Robust, RobustScale, Termination,
    VarianceComponents,
};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project, Sigma};

const SAMPLES: usize = 40;

fn ways() -> [AdjustOptions; 3] {
    let with = |robust, snooping| AdjustOptions { robust, snooping, ..AdjustOptions::default() };
    [with(None, true), with(Some(Robust::Huber), false), with(Some(Robust::Tukey), false)]
}

fn run(project: &Project, options: &AdjustOptions) -> Adjustment {
    let adjustment = adjust(project, options, &mut |_| true).expect("solvable");
    assert_eq!(adjustment.termination, Termination::Converged);
    adjustment
}

#[test]
fn intervals_hold_what_they_state_on_clean_data() {
    for trial in trials().iter().take(4) {
        for options in ways() {
            let found = clean(&trial.wanted, &options, SAMPLES, 500);
            let named = format!("{} {:?} {}: {found:?}", trial.name, options.robust, options.snooping);
            assert_eq!(found.thrown, 0, "{named}");
            // Of 40 samples the mean sigma0 has a standard deviation of 1/√(2·40·r), the coverage one of about 0.01.
            let spread = 3.0 / (2.0 * SAMPLES as f64 * found.redundancy as f64).sqrt();
            assert!((0.95 - spread..=1.05 + spread).contains(&found.sigma0), "{named}");
            assert!((0.91..=0.985).contains(&found.coverage), "{named}");
        }
    }
}

#[test]
fn gross_errors_are_found_and_stop_nothing() {
    for trial in trials().iter().take(4) {
        for options in ways() {
            let found = spoiled(&trial.wanted, &options, 0.03, 25, 600);
            let named = format!("{} {:?} {}: {found:?}", trial.name, options.robust, options.snooping);
            assert_eq!((found.thrown, found.not_converged), (0, 0), "{named}");
            if trial.well_controlled {
                assert!(found.all_found >= 0.95, "{named}");
                assert!((0.95..=1.05).contains(&found.ratio), "{named}");
            }
        }
    }
}

#[test]
fn huge_errors_and_poor_initial_values_still_end_in_a_clean_result() {
    let trial = &trials()[2];
    let truth = exact(&trial.wanted, 700);
    let (mut noise, mut random) = (Noise::new(700, 0), Uniform(700));
    for _ in 0..15 {
        let mut project = noisy(&truth, &mut noise);
        let planted = spoil(&mut project, 0.02, 20_000.0, &mut random);
        let found = run(&project, &AdjustOptions { snooping: true, ..AdjustOptions::default() });
        assert!(planted.iter().all(|row| !found.observations[*row].enabled), "{:?}", found.gross_errors);
        assert!(found.sigma0.is_some_and(|s| (0.8..1.2).contains(&s)), "{:?}", found.sigma0);
    }
}

/// Three points is all a photo has: one wrong by much cannot be taken out, and is said to be kept or shows in the test.
#[test]
fn what_the_network_cannot_do_without_is_kept() {
    let wanted = Wanted { photos: 5, points: 14, cameras: vec![brown(&[])], sigma_px: 0.1, ..Wanted::default() };
    let mut project = noisy(&exact(&wanted, 710), &mut Noise::new(710, 0));
    let mut left = 4;
    project.observations.retain(|o| {
        let own = o.photo == "f2";
        left -= usize::from(own && left > 0);
        !own || left > 0
    });
    let row = project.observations.iter().position(|o| o.photo == "f2").expect("a ray");
    project.observations[row].u += 40.0;
    for options in ways() {
        let found = run(&project, &options);
        assert!(found.photos.iter().any(|p| p.id == "f2"), "the photo stays");
        if options.snooping {
            let kept = found.gross_errors.iter().any(|g| g.action == GrossErrorAction::Kept && g.photo == "f2");
            let clean = found.global_test.as_ref().is_some_and(|t| t.statistic <= t.upper);
            assert!(kept || clean, "{:?}", found.gross_errors);
        }
    }
}

#[test]
fn the_scale_of_robust_weights_falls_below_the_prior_one_only_when_asked() {
    let trial = &trials()[2];
    let mut project = noisy(&exact(&trial.wanted, 720), &mut Noise::new(720, 0));
    // Five times too pessimistic.
    project.observations.iter_mut().for_each(|o| o.sigma = Sigma::One(0.5));
    let weighted = |robust_scale| {
        let options = AdjustOptions { robust: Some(Robust::Huber), robust_scale, ..AdjustOptions::default() };
        run(&project, &options).observations.iter().filter(|o| o.weight.is_some()).count()
    };
    assert_eq!(weighted(RobustScale::AtLeastPrior), 0);
    assert!(weighted(RobustScale::Estimated) > 10);
}

#[test]
fn the_global_test_holds_whatever_the_lens_does() {
    for k1 in [0.0, 1e-4, 2.56e-4] {
        let (wanted, corner) = distorted(k1);
        let found = clean(&wanted, &AdjustOptions::default(), 60, 730);
        assert!(found.passed >= 0.87 && (found.sigma0 - 1.0).abs() < 0.01, "{corner} px: {found:?}");
    }
}

#[test]
fn variance_components_find_the_true_ones() {
    let mut cameras = vec![brown(&[Parameter::C]), brown(&[Parameter::C])];
    cameras[1].id = "other".into();
    let wanted = Wanted {
        photos: 12,
        points: 40,
        cameras,
        datum: DatumKind::Control,
        control: (12, 0.1),
        distances: (14, 0.1),
        sigma_px: 0.1,
        ..Wanted::default()
    };
    let mut project = noisy(&exact(&wanted, 740), &mut Noise::new(740, 0));
    // Stated twice too large for one camera, half as large for the other; control three times too small, distances right.
    for o in &mut project.observations {
        let even = o.photo[1..].parse::<usize>().expect("numbered") % 2 == 0;
        o.sigma = Sigma::One(if even { 0.2 } else { 0.05 });
    }
    project.points.iter_mut().filter_map(|p| p.sigma.as_mut()).for_each(|s| *s = [Some(0.033); 3]);
    let choice = VarianceComponents { per_camera: true, unmodelled: false };
    let options = AdjustOptions { variance_components: Some(choice), ..AdjustOptions::default() };
    let found = run(&project, &options);
    assert!(!found.advice.contains(&Advice::VarianceComponentsUnsettled));
    assert!((found.sigma0.expect("redundant") - 1.0).abs() < 1e-3 && found.global_test.is_none());
    let image = |camera: &str| ObservationGroup::Image { camera: Some(camera.into()) };
    let expected = [
        (image("brown"), 0.5),
        (image("other"), 2.0),
        (ObservationGroup::Control, 0.1 / 0.033),
        (ObservationGroup::Distance, 1.0),
    ];
    for (group, factor) in expected {
        let component = found.variance_components.iter().find(|c| c.group == group).expect("listed");
        let sigma = component.factor_sigma.expect("enough redundancy");
        assert!((component.factor - factor).abs() < 3.5 * sigma, "{component:?} against {factor}");
        assert!(sigma < 0.5 * component.factor, "{component:?}");
    }
}

#[test]
fn what_is_not_modelled_is_told_apart_from_the_noise() {
    let trial = &trials()[3];
    let truth = exact(&trial.wanted, 750);
    let mut noise = Noise::new(750, 0);
    let mut project = truth.clone();
    for (k, o) in project.observations.iter_mut().enumerate() {
        let sigma = [0.02, 0.1, 0.3][k % 3];
        o.sigma = Sigma::One(sigma);
        o.u += sigma.hypot(0.08) * noise.normal();
        o.v += sigma.hypot(0.08) * noise.normal();
    }
    let choice = VarianceComponents { per_camera: false, unmodelled: true };
    let found = run(&project, &AdjustOptions { variance_components: Some(choice), ..AdjustOptions::default() });
    let component = &found.variance_components[0];
    let (u, error) = (component.unmodelled.expect("asked for"), component.unmodelled_sigma.expect("told"));
    assert!((u - 0.08).abs() < 3.5 * error && error < 0.02, "{component:?}");
    assert!((component.factor - 1.0).abs() < 3.5 * component.factor_sigma.expect("told"), "{component:?}");
    assert!(found.sigma0.is_some_and(|s| (s - 1.0).abs() < 0.02), "{:?}", found.sigma0);
}
