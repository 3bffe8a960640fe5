//! Correlations beyond the limit, grouped by camera.

use serde::{Deserialize, Serialize};

use super::Advice;
use crate::project::Parameter;

/// Two parameters that are strongly correlated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CorrelatedPair {
    /// Name of one parameter.
    pub first: String,
    /// Name of the other.
    pub second: String,
    /// Their correlation.
    pub correlation: f64,
}

/// The parameters of a camera that are strongly correlated, or those of a photo with its camera's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CorrelationGroup {
    /// Camera identifier.
    pub camera: String,
    /// Photo identifier, where one parameter of each pair is the photo's, or the interior orientation is.
    pub photo: Option<String>,
    /// All pairs, the largest correlation first.
    pub pairs: Vec<CorrelatedPair>,
    /// The parameter that is held at the least cost: the finer one of the first pair. Null where neither is a camera's.
    pub hold: Option<Parameter>,
}

/// Every [`Advice::HighCorrelation`] in its group, the groups in the order of their first.
pub fn correlation_groups(advice: &[Advice]) -> Vec<CorrelationGroup> {
    let mut groups: Vec<CorrelationGroup> = Vec::new();
    for one in advice {
        let Advice::HighCorrelation { camera, photo, first, second, correlation } = one else { continue };
        let pair = CorrelatedPair { first: first.clone(), second: second.clone(), correlation: *correlation };
        match groups.iter_mut().find(|group| group.camera == *camera && group.photo == *photo) {
            Some(group) => group.pairs.push(pair),
            None => groups.push(CorrelationGroup {
                camera: camera.clone(),
                photo: photo.clone(),
                pairs: vec![pair],
                hold: None,
            }),
        }
    }
    for group in &mut groups {
        group.pairs.sort_by(|a, b| b.correlation.abs().total_cmp(&a.correlation.abs()));
        // The later of the two is the finer one.
        group.hold = group.pairs.first().and_then(|pair| pair.second.parse().or_else(|()| pair.first.parse()).ok());
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn pairs_of_one_camera_are_one_group_and_those_of_a_photo_another() {
        let pair = |photo: Option<&str>, first: &str, second: &str, correlation| Advice::HighCorrelation {
            camera: "k".into(),
            photo: photo.map(str::to_owned),
            first: first.into(),
            second: second.into(),
            correlation,
        };
        let all = [
            pair(None, "k1", "k2", -0.96),
            pair(Some("7"), "x", "c", 0.97),
            pair(None, "k2", "k3", -0.99),
            Advice::GrossErrorsUnsettled,
            pair(Some("7"), "x", "phi", -0.98),
        ];
        let groups = correlation_groups(&all);
        assert_eq!(groups.len(), 2);
        assert_eq!((groups[0].photo.as_deref(), groups[0].pairs.len(), groups[0].hold), (None, 2, Some(Parameter::K3)));
        assert_eq!(groups[0].pairs[0].correlation, -0.99);
        // neither is a parameter of the camera
        assert_eq!((groups[1].photo.as_deref(), groups[1].hold), (Some("7"), None));
    }
}
