//! Every kind of advice has its words.

use sightline::adjustment::{
    Advice as A, CameraDoubt, Criteria, Exchange, ImplausibleCamera, MirroredControl, OneStation, PatternKind, Remedy,
    UndecidedAxes, UnitOf, UnitRatio,
};
use sightline::orient::Note;

use super::*;

/// One of every kind that the engine gives; a new kind does not compile here until it has its place.
fn every_kind() -> Vec<A> {
    let pair = || ("a".to_owned(), "1".to_owned());
    let all = vec![
        A::HighCorrelation {
            camera: "k".into(),
            photo: None,
            first: "c".into(),
            second: "k1".into(),
            correlation: 0.97,
        },
        A::LowRedundancy { observations: vec![pair()], given: Vec::new() },
        A::TwoRays { points: vec!["1".into()] },
        A::NarrowIntersection { points: vec![("1".into(), 0.01)] },
        A::BehindCamera { observations: vec![pair()] },
        A::DistanceUnused { distances: vec![pair()] },
        A::WeakPrincipalDistance {
            camera: "k".into(),
            photo: None,
            parameter: "c".into(),
            value: 20.0,
            sigma: 3.0,
            convergence: 0.1,
        },
        A::GrossErrorsUnsettled,
        A::VarianceComponentsUnsettled,
        A::ResidualPattern {
            camera: "k".into(),
            pattern: PatternKind::Radius,
            photos: Vec::new(),
            p_value: 1e-30,
            rms_px: 0.4,
            max_px: 3.1,
            sigma0: 1.1,
            remedy: Remedy::Model { models: vec!["opencv_fisheye".into()] },
        },
        A::SigmasTooSmall { sigma0: 3.0, unmodelled: None },
        A::UnmodelledAgain { sigma0: 0.2, unmodelled: 0.1 },
        A::Insignificant {
            camera: "k".into(),
            photo: None,
            parameter: Parameter::P1,
            ratio: 0.4,
            with: None,
            correlation: None,
        },
        A::Suspected { count: 1, observations: vec![("a".into(), "1".into(), 6.0)], given: Vec::new() },
        A::ControlMisfit { point: "9".into(), difference: [30.2, 0.1, -0.4], sigma_ratio: 300.0 },
        A::ExchangedPoints { points: ["9".into(), "7".into()] },
        A::DoublePoints { pairs: vec![("5".into(), "u12".into())] },
        A::MirroredControl(MirroredControl {
            exchange: Exchange::Xy,
            alternatives: vec![Exchange::X],
            rms_given: 0.2,
            rms_exchanged: 0.001,
            points: 8,
        }),
        A::UndecidedAxes(UndecidedAxes { points: 4, normal: [0.0, 1.0, 0.0] }),
        A::UnitRatio(UnitRatio {
            of: UnitOf::Distance,
            ratio: 1000.4,
            nearest: 1000.0,
            distances: vec![pair()],
            camera: None,
        }),
        A::OneStation(OneStation { photos: vec!["a".into(), "b".into()], all: false }),
        A::ImplausibleCamera(ImplausibleCamera {
            camera: "k".into(),
            doubt: CameraDoubt::FieldOfView { angle: 3.1, value: 36.0, pixels: true },
        }),
        A::NoScale,
    ];
    for advice in &all {
        match advice {
            A::HighCorrelation { .. }
            | A::LowRedundancy { .. }
            | A::TwoRays { .. }
            | A::NarrowIntersection { .. }
            | A::BehindCamera { .. }
            | A::DistanceUnused { .. }
            | A::WeakPrincipalDistance { .. }
            | A::GrossErrorsUnsettled
            | A::VarianceComponentsUnsettled
            | A::ResidualPattern { .. }
            | A::SigmasTooSmall { .. }
            | A::UnmodelledAgain { .. }
            | A::Insignificant { .. }
            | A::Suspected { .. }
            | A::ControlMisfit { .. }
            | A::ExchangedPoints { .. }
            | A::DoublePoints { .. }
            | A::MirroredControl(_)
            | A::UndecidedAxes(_)
            | A::UnitRatio(_)
            | A::OneStation(_)
            | A::ImplausibleCamera(_)
            | A::NoScale => {}
        }
    }
    all
}

#[test]
fn every_advice_has_a_button() {
    for advice in every_kind() {
        let item = network_item(&advice, &Criteria::default(), "mm");
        assert_ne!(item.target, Target::None, "{}", item.title);
        let choices = if matches!(advice, A::MirroredControl(_)) { 2 } else { 1 };
        assert_eq!(item.target.buttons().len(), choices, "{}", item.title);
        assert!(!item.title.is_empty() && !item.body.is_empty());
    }
    let notes = [
        Note::PrincipalDistanceWeak { camera: "k".into(), value: 20.0, sigma: None },
        Note::PrincipalDistanceChanged { camera: "k".into(), value: 20.0, given: 10.0 },
        Note::Groups { groups: vec![vec!["a".into(), "b".into()], vec!["c".into(), "d".into()]] },
    ];
    for note in notes {
        assert_ne!(note_item(&note, "mm").map(|item| item.target), Some(Target::None), "{note:?}");
    }
}
