//! Tables of observations of other kinds than image coordinates, and of the search for gross errors.

use super::{ResultTable, value};
use sightline::adjustment::{Adjustment, Given, GrossErrorAction};
use sightline::axes::ShownAxes;
use sightline::camera::parameter_unit;
use sightline::project::Project;

/// Key of a given observation: kind, photo, point, to, camera, component.
fn names(axes: ShownAxes, what: Option<&Given>) -> [String; 6] {
    let axis = |axis: usize| axes.letter(axis);
    let [kind, photo, point, to, camera, component] = match what {
        None => ["image", "", "", "", "", ""],
        Some(Given::Control { point, axis: a }) => ["control", "", point, "", "", axis(*a)],
        Some(Given::Position { photo, axis: a }) => ["position", photo, "", "", "", axis(*a)],
        Some(Given::Distance { from, to }) => ["distance", "", from, to, "", ""],
        Some(Given::Parameter { camera, photo, parameter }) => {
            ["parameter", photo.as_deref().unwrap_or_default(), "", "", camera, parameter.name()]
        }
    };
    [kind, photo, point, to, camera, component].map(str::to_owned)
}

/// Observations of other kinds with their statistics, each in its own unit.
pub fn observations(project: &Project, adjustment: &Adjustment) -> ResultTable {
    let effect = format!("effect [{}]", project.unit);
    let mut table = ResultTable::new([
        "kind",
        "photo",
        "point",
        "to",
        "camera",
        "component",
        "unit",
        "residual",
        "sigma",
        "r",
        "w",
        "mdb",
        "effect_point",
        &effect,
        "weight",
        "enabled",
    ]);
    for given in &adjustment.given {
        let unit = match &given.what {
            Given::Parameter { camera, parameter, .. } => {
                let camera = project.cameras.iter().find(|c| c.id == *camera);
                camera.map(|camera| parameter_unit(camera, *parameter)).unwrap_or_default()
            }
            _ => project.unit.clone(),
        };
        let test = given.reliability.unwrap_or_default();
        let mut row: Vec<String> = names(project.shown_axes(), Some(&given.what)).into();
        row.push(unit);
        row.extend(
            [given.residual, Some(given.sigma), given.reliability.map(|r| r.redundancy), test.w, test.mdb].map(value),
        );
        row.push(given.effect_point.clone().unwrap_or_default());
        row.extend([value(given.effect), value(Some(given.weight.unwrap_or(1.0)))]);
        row.push((if given.enabled { "yes" } else { "no" }).to_owned());
        table.rows.push(row);
    }
    table
}

/// Observations that were rejected, restored or downweighted, and why.
pub fn record(project: &Project, adjustment: &Adjustment) -> ResultTable {
    let mut table = ResultTable::new([
        "round",
        "action",
        "kind",
        "photo",
        "point",
        "to",
        "camera",
        "component",
        "statistic",
        "limit",
        "consequence",
    ]);
    for entry in &adjustment.gross_errors {
        let action = match entry.action {
            GrossErrorAction::Removed => "removed",
            GrossErrorAction::Restored => "restored",
            GrossErrorAction::Downweighted => "downweighted",
            GrossErrorAction::Kept => "kept",
        };
        let mut names = names(project.shown_axes(), entry.given.as_ref());
        if entry.given.is_none() {
            (names[1], names[2]) = (entry.photo.clone(), entry.point.clone());
        }
        let mut row = vec![entry.round.to_string(), action.to_owned()];
        row.extend(names);
        row.extend([entry.statistic, entry.limit].map(|number| value(Some(number))));
        row.push((if entry.consequence { "yes" } else { "no" }).to_owned());
        table.rows.push(row);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::adjustment::{GivenObservation, GrossError};
    use sightline::statistics::reliability::Reliability;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn every_kind_has_its_row() {
        let what = Given::Distance { from: "a".into(), to: "b,c".into() };
        let given = GivenObservation {
            what: what.clone(),
            residual: Some(-0.25),
            sigma: 0.5,
            reliability: Some(Reliability { redundancy: 0.5, w: Some(-1.5), mdb: None }),
            effect: Some(2.0),
            effect_point: Some("a".into()),
            weight: None,
            enabled: true,
        };
        let entry = GrossError {
            photo: String::new(),
            point: String::new(),
            given: Some(what),
            action: GrossErrorAction::Removed,
            statistic: 7.5,
            limit: 3.25,
            round: 2,
            consequence: false,
        };
        let image = GrossError { photo: "p".into(), point: "q".into(), given: None, ..entry.clone() };
        let adjustment = Adjustment { given: vec![given], gross_errors: vec![entry, image], ..Adjustment::default() };
        let files =
            super::super::write(&Project::default(), Some(&adjustment), super::super::ResultSeparator::Comma).unwrap();
        let text = |name: &str| String::from_utf8(files[name].clone()).unwrap();
        assert!(text("given.csv").ends_with("distance,,a,\"b,c\",,,mm,-0.25,0.5,0.5,-1.5,,a,2,1,yes\n"));
        assert!(
            text("gross_errors.csv")
                .ends_with("2,removed,distance,,a,\"b,c\",,,7.5,3.25,no\n2,removed,image,p,q,,,,7.5,3.25,no\n")
        );
    }
}
