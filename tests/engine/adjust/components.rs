//! Standard errors that are estimated from the residuals: which groups have enough of them, and what can be said of the fit then.

use sightline::adjust::adjust;
use sightline::adjustment::{
    AdjustOptions, Adjustment, Advice, NotEstimated, ObservationGroup, VarianceComponent, VarianceComponents,
};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project, ReportLanguage, Sigma};
use sightline_report::report;

use crate::support::extent;
use crate::support::networks::{Uniform, Wanted, brown, exact, noisy};

/// Two-sided 0.1 % of a normal distribution.
const BEYOND: f64 = 3.29;

fn estimated(project: &Project, per_camera: bool, unmodelled: bool) -> Adjustment {
    let choice = VarianceComponents { per_camera, unmodelled };
    let options = AdjustOptions { variance_components: Some(choice), ..AdjustOptions::default() };
    adjust(project, &options, &mut |_| true).expect("solvable")
}

fn whole(random: &mut Uniform, low: usize, high: usize) -> usize {
    random.between(low as f64, high as f64 + 1.0 - 1e-9) as usize
}

/// Networks whose place or length hangs on a group of any redundancy from 1 on: control, distances, cameras of few photos.
fn network(seed: u64) -> (Project, Project) {
    let random = &mut Uniform(seed);
    let cameras = (0..whole(random, 1, 2)).map(|k| {
        let mut camera = brown(&[Parameter::C]);
        camera.id = format!("k{k}");
        camera
    });
    let points = whole(random, 14, 30);
    let wanted = Wanted {
        photos: whole(random, 4, 7),
        points,
        cameras: cameras.collect(),
        datum: DatumKind::Control,
        control: (whole(random, 3, 12), random.between(0.05, 0.5)),
        distances: (whole(random, 0, 6), random.between(0.05, 0.3)),
        sigma_px: 0.2,
        ..Wanted::default()
    };
    let truth = exact(&wanted, seed);
    let project = noisy(&truth, &mut Noise::new(seed, 4));
    (truth, project)
}

fn group(a: &Adjustment, of: &ObservationGroup) -> VarianceComponent {
    a.variance_components.iter().find(|c| c.group == *of).expect("listed").clone()
}

#[test]
fn coordinates_are_as_far_off_as_is_stated_whatever_hangs_on_a_small_group() {
    let (mut beyond, mut all, mut small, mut worst) = (0, 0, 0, 0.0_f64);
    let mut by_redundancy = [[0, 0]; 5];
    for seed in 0..extent::cases(80, 400) as u64 {
        let (truth, project) = network(20_000 + seed);
        let found = estimated(&project, seed % 2 == 0, false);
        let (mut squares, mut count) = (0.0, 0);
        let control = group(&found, &ObservationGroup::Control);
        small += usize::from(control.not_estimated.is_some());
        let class = [5.0, 10.0, 15.0, 20.0].iter().filter(|limit| control.redundancy >= **limit).count();
        for point in &found.points {
            let known = truth.points.iter().find(|p| p.id == point.id).and_then(|p| p.xyz).expect("known");
            let sigma = point.sigma.expect("stated");
            for a in 0..3 {
                let z = (point.xyz[a] - known[a]) / sigma[a];
                beyond += usize::from(z.abs() > BEYOND);
                by_redundancy[class][0] += usize::from(z.abs() > BEYOND);
                by_redundancy[class][1] += 1;
                squares += z * z;
                count += 1;
            }
        }
        all += count;
        worst = worst.max((squares / count as f64).sqrt());
    }
    let share = f64::from(beyond as u32) / f64::from(all as u32);
    println!(
        "{beyond} of {all} beyond {BEYOND}: {:.2} %; largest rms z of a network {worst:.2}; control not estimated in {small}",
        100.0 * share
    );
    println!("beyond, all by redundancy of control below 5, 10, 15, 20, more: {by_redundancy:?}");
    assert!(small > extent::cases(20, 100), "{small}");
    assert!(share < 0.004, "{share}");
    assert!(worst < 3.0, "{worst}");
}

#[test]
fn what_was_not_estimated_says_why_and_stays_as_it_was() {
    let mut kinds = [0, 0];
    for seed in 0..60 {
        let (_, project) = network(30_000 + seed);
        let found = estimated(&project, seed % 2 == 0, seed % 3 == 0);
        for c in &found.variance_components {
            kinds[usize::from(c.not_estimated.is_some())] += 1;
            let image = matches!(c.group, ObservationGroup::Image { .. });
            assert_eq!(c.a_priori_px.is_some(), image);
            if let Some(px) = c.a_priori_px {
                assert!((px - 0.2).abs() < 1e-12);
            }
            match c.not_estimated {
                Some(NotEstimated::LittleRedundancy { needed }) => {
                    assert!(c.redundancy < needed && needed == 10.0, "{c:?}");
                    assert!(c.factor == 1.0 && c.factor_sigma.is_none() && c.unmodelled_sigma.is_none(), "{c:?}");
                    assert!(c.unmodelled.is_none_or(|u| u == 0.0));
                }
                Some(other) => panic!("{other:?}"),
                None => assert!(c.redundancy > 0.9 * 10.0 && c.factor_sigma.is_some_and(|s| s > 0.0 || seed % 3 == 0)),
            }
        }
        assert!(!found.advice.contains(&Advice::VarianceComponentsUnsettled), "{seed}");
    }
    assert!(kinds.iter().all(|n| *n > 20), "{kinds:?}");
}

/// Standard errors that are wrong by any factor: the test fails before they are estimated, and there is none afterwards, neither in the
/// result nor in the report of any language.
#[test]
fn estimated_standard_errors_leave_no_verdict() {
    for seed in 0..24 {
        let random = &mut Uniform(40_000 + seed);
        let (_, mut project) = network(40_000 + seed);
        let factor = [0.3, 0.5, 1.0, 1.9, 4.0][whole(random, 0, 4)];
        project.observations.iter_mut().for_each(|o| o.sigma = Sigma::One(0.2 / factor));
        let plain = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
        let test = plain.global_test.as_ref().expect("a test");
        assert!(factor == 1.0 || !test.passed, "{factor}: {test:?}");
        assert!(!plain.standard_errors_estimated());
        let found = estimated(&project, false, seed % 4 == 3);
        assert!(found.global_test.is_none() && found.standard_errors_estimated());
        let silent = |a: &Advice| !matches!(a, Advice::SigmasTooSmall { .. } | Advice::UnmodelledAgain { .. });
        assert!(found.advice.iter().all(silent));
        let image = group(&found, &ObservationGroup::Image { camera: None });
        let total = (image.factor * 0.2 / factor).hypot(image.unmodelled.unwrap_or(0.0));
        assert!((total / 0.2 - 1.0).abs() < 0.25, "{image:?}");
        for (language, sentences) in [
            (ReportLanguage::English, ["The standard errors were estimated from the residuals", "times the a priori"]),
            (ReportLanguage::Korean, ["표준오차를 잔차에서 추정하였습니다", "사전 표준오차"]),
        ] {
            let mut said = project.clone();
            said.report.language = Some(language);
            let html = report(&said, Some(&found)).expect("a report").html();
            assert!(sentences.iter().all(|sentence| html.contains(sentence)));
            for verdict in [
                "passes the global test",
                "fails the global test",
                ">passed<",
                ">failed<",
                "통과하였습니다",
                "통과하지 못하였습니다",
            ] {
                assert!(!html.contains(verdict), "{verdict}");
            }
        }
    }
}

/// Too little of everything: nothing is estimated, and the test stands as it does without.
#[test]
fn where_nothing_was_estimated_the_test_stands() {
    for seed in 0..10 {
        let wanted = Wanted {
            photos: 2,
            points: 8,
            cameras: vec![brown(&[])],
            datum: DatumKind::Control,
            control: (3, 0.05),
            ..Wanted::default()
        };
        let project = noisy(&exact(&wanted, 50_000 + seed), &mut Noise::new(seed, 4));
        let plain = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
        let found = estimated(&project, false, false);
        assert!(found.variance_components.iter().all(|c| c.not_estimated.is_some() && c.factor == 1.0));
        let (a, b) = (plain.global_test.expect("a test"), found.global_test.expect("a test"));
        assert!((a.statistic - b.statistic).abs() < 1e-6 && a.passed == b.passed);
    }
}
