//! Tests of observations, parameters and standard errors of a result, with its criteria.

use crate::adjustment::{AdjustedCamera, AdjustedObservation, Adjustment, Advice, Criteria, GivenObservation};
use crate::statistics::distribution::critical_among;

/// Two suggestions for what is not modelled that differ by less are one, pixels.
const SAME_UNMODELLED: f64 = 0.0005;

/// How often the observations of a sound network are suspected.
const FALSE_SUSPICION: f64 = 0.01;

/// What is wrong with the fit; `unmodelled` is what its residuals suggest.
pub fn judgement(adjustment: &Adjustment, unmodelled: Option<f64>) -> Vec<Advice> {
    let mut advice = Vec::new();
    advice.extend(standard_errors(adjustment, unmodelled));
    adjustment.cameras.iter().for_each(|camera| advice.extend(insignificant(camera, &adjustment.criteria)));
    advice.extend(suspected(adjustment));
    advice
}

/// Verdict on the standard errors of the image coordinates from σ0.
fn standard_errors(adjustment: &Adjustment, unmodelled: Option<f64>) -> Option<Advice> {
    let (sigma0, test) = (adjustment.sigma0?, adjustment.global_test.as_ref()?);
    // A systematic error is not noise: the standard errors are judged by σ0 without the named pattern.
    let pattern = adjustment.patterns.iter().find(|pattern| pattern.named);
    if pattern.is_some_and(|pattern| pattern.sigma0 <= adjustment.criteria.sigma0) {
        return None;
    }
    if test.statistic > test.upper && sigma0 > adjustment.criteria.sigma0 {
        return Some(Advice::SigmasTooSmall { sigma0, unmodelled });
    }
    let taken = adjustment.options.unmodelled;
    let another = unmodelled.filter(|px| !test.passed && taken > 0.0 && (px - taken).abs() > SAME_UNMODELLED);
    another.map(|unmodelled| Advice::UnmodelledAgain { sigma0, unmodelled })
}

/// Observations whose test value exceeds the critical one, the largest first. Of many observations some exceed it though nothing
/// is wrong: nobody is sent to look unless the largest of all does so in one sound network of a hundred.
fn suspected(adjustment: &Adjustment) -> Option<Advice> {
    let critical = adjustment.criteria.w;
    let of_rays = adjustment.observations.iter().filter(|o| o.enabled).flat_map(|o| [o.wx, o.wy]);
    let of_given = adjustment.given.iter().filter(|g| g.enabled).map(|g| g.reliability.and_then(|r| r.w));
    let tested = of_rays.chain(of_given).flatten();
    let (count, worst) = tested.fold((0, 0.0_f64), |(count, worst), w| (count + 1, worst.max(w.abs())));
    if worst <= critical.max(critical_among(count, FALSE_SUSPICION)) {
        return None;
    }
    let largest = |o: &AdjustedObservation| {
        [o.wx, o.wy].into_iter().flatten().max_by(|a, b| a.abs().total_cmp(&b.abs())).filter(|w| w.abs() > critical)
    };
    let used = adjustment.observations.iter().filter(|o| o.enabled);
    let mut observations: Vec<_> = used.filter_map(|o| Some((o, largest(o)?))).collect();
    observations.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let tested = adjustment.given.iter().filter(|g| g.enabled);
    let w = |g: &GivenObservation| g.reliability.and_then(|r| r.w).filter(|w| w.abs() > critical);
    let mut given: Vec<_> = tested.filter_map(|g| Some((g.what.clone(), w(g)?))).collect();
    given.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let count = observations.len() + given.len();
    observations.truncate(Advice::SUSPECTS);
    let observations = observations.into_iter().map(|(o, w)| (o.photo.clone(), o.point.clone(), w)).collect();
    (count > 0).then_some(Advice::Suspected { count, observations, given })
}

/// Parameters of distortion that are not significantly different from 0, each with the one it is most correlated with.
fn insignificant(camera: &AdjustedCamera, criteria: &Criteria) -> Vec<Advice> {
    let AdjustedCamera { significance, correlation, .. } = camera;
    let small = significance.iter().filter(|(_, ratio)| **ratio < criteria.significance);
    small
        .map(|(&parameter, &ratio)| {
            let own = correlation.names.iter().position(|name| *name == parameter.name());
            let row = own.and_then(|k| correlation.matrix.get(k)).into_iter().flatten().enumerate();
            let others = row.filter(|(k, _)| Some(*k) != own);
            let strongest = others.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
            Advice::Insignificant {
                camera: camera.camera.id.clone(),
                photo: camera.photo.clone(),
                parameter,
                ratio,
                with: strongest.and_then(|(k, _)| correlation.names[k].parse().ok()),
                correlation: strongest.map(|(_, r)| *r),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjustment::{AdjustOptions, Correlation, Given, GlobalTest};
    use crate::project::{Camera, Interior, Parameter};
    use crate::statistics::reliability::Reliability;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn tested(sigma0: f64, passed: bool, unmodelled: f64) -> Adjustment {
        let statistic = if passed { 10.0 } else { 30.0 };
        Adjustment {
            options: AdjustOptions { unmodelled, ..AdjustOptions::default() },
            sigma0: Some(sigma0),
            global_test: Some(GlobalTest { statistic, lower: 5.0, upper: 20.0, passed }),
            ..Adjustment::default()
        }
    }

    #[test]
    fn sigma0_is_judged_with_its_test() {
        assert_eq!(judgement(&tested(1.0, true, 0.0), None), []);
        // Beyond the test's limits, but not by much.
        assert_eq!(judgement(&tested(1.5, false, 0.0), Some(0.1)), []);
        let small = Advice::SigmasTooSmall { sigma0: 3.0, unmodelled: Some(0.1) };
        assert_eq!(judgement(&tested(3.0, false, 0.0), Some(0.1)), [small]);
        let again = Advice::UnmodelledAgain { sigma0: 1.5, unmodelled: 0.1 };
        assert_eq!(judgement(&tested(1.5, false, 0.2), Some(0.1)), [again]);
        assert_eq!(judgement(&tested(1.5, false, 0.1002), Some(0.1)), []);
    }

    #[test]
    fn suspects_are_counted_and_the_worst_named_first() {
        let row = |k: usize| AdjustedObservation {
            photo: "a".into(),
            point: k.to_string(),
            wx: Some(if k.is_multiple_of(2) { k as f64 } else { 0.0 }),
            wy: Some(-1.0),
            enabled: k != 58,
            ..AdjustedObservation::default()
        };
        // One of 120 a little beyond the limit is chance.
        let mut sound = Adjustment { observations: (0..60).map(|_| row(1)).collect(), ..Adjustment::default() };
        sound.observations[0].wx = Some(3.5);
        assert_eq!(judgement(&sound, None), []);
        let what = Given::Distance { from: "1".into(), to: "2".into() };
        let given = |w: f64| GivenObservation {
            what: what.clone(),
            residual: Some(1.0),
            sigma: 1.0,
            reliability: Some(Reliability { redundancy: 0.5, w: Some(w), mdb: None }),
            effect: None,
            effect_point: None,
            weight: None,
            enabled: true,
        };
        let adjustment = Adjustment {
            observations: (0..60).map(row).collect(),
            given: vec![given(3.2), given(-4.0)],
            ..Adjustment::default()
        };
        let [Advice::Suspected { count, observations, given }] = &judgement(&adjustment, None)[..] else { panic!() };
        // 4, 6 … 56 and one distance.
        assert_eq!((*count, observations.len(), given.len()), (28, Advice::SUSPECTS, 1));
        assert_eq!(observations[0], ("a".into(), "56".into(), 56.0));
        assert_eq!(given[0], (what, -4.0));
    }

    #[test]
    fn a_parameter_that_is_not_told_from_zero_names_what_it_moves_with() {
        let camera = AdjustedCamera {
            camera: Camera::new("k", 10, 10, Interior::brown(1.0)),
            photo: None,
            sigma: Default::default(),
            significance: [(Parameter::K1, 5.0), (Parameter::K2, 1.5)].into(),
            correlation: Correlation {
                names: ["c", "k1", "k2"].map(String::from).into(),
                matrix: vec![vec![1.0, 0.1, 0.2], vec![0.1, 1.0, -0.9], vec![0.2, -0.9, 1.0]],
            },
        };
        let adjustment = Adjustment { cameras: vec![camera], ..Adjustment::default() };
        let told = Advice::Insignificant {
            camera: "k".into(),
            photo: None,
            parameter: Parameter::K2,
            ratio: 1.5,
            with: Some(Parameter::K1),
            correlation: Some(-0.9),
        };
        assert_eq!(judgement(&adjustment, None), [told]);
    }
}
