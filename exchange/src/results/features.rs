//! Tables of what was measured on the result: features, their residuals, points in the object's own systems.

use super::{ResultTable, coordinates, value, values};
use sightline::adjustment::{Adjustment, MeasuredFeature, Quantity};
use sightline::axes::ShownAxes;
use sightline::project::Project;

/// Features, residuals and systems, each where there are any.
pub fn tables(project: &Project, adjustment: &Adjustment) -> Vec<(&'static str, ResultTable)> {
    let (unit, axes) = (&project.unit, project.shown_axes());
    let mut tables = Vec::new();
    if !adjustment.features.is_empty() {
        tables.push(("features", features(unit, axes, &adjustment.features)));
    }
    if adjustment.features.iter().any(|f| !f.residuals.is_empty()) {
        tables.push(("feature_residuals", residuals(unit, axes, &adjustment.features)));
    }
    if adjustment.systems.iter().any(|s| !s.points.is_empty()) {
        // A system of the object's own has no east and no north.
        let heading = coordinates(ShownAxes::XYZ, unit);
        let mut table = ResultTable::new(["system", "id"].into_iter().chain(heading.iter().map(String::as_str)));
        for system in &adjustment.systems {
            for point in &system.points {
                let mut row = vec![system.id.clone(), point.id.clone()];
                row.extend(values(Some(point.xyz)));
                row.extend(values(point.sigma));
                table.rows.push(row);
            }
        }
        tables.push(("systems", table));
    }
    tables
}

/// Angles in degrees, as in the table of photos.
fn features(unit: &str, axes: ShownAxes, features: &[MeasuredFeature]) -> ResultTable {
    let position = coordinates(axes, unit);
    let direction = axes.names().map(|name| format!("d{name}"));
    let form = ["rms", "min", "max"].map(|name| format!("{name} [{unit}]"));
    let heading = ["id", "kind", "points", "quantity", "unit", "value", "sigma"];
    let names = heading.into_iter().chain(position.iter().map(String::as_str));
    let names = names
        .chain(direction.iter().map(String::as_str))
        .chain(["s_direction [deg]"])
        .chain(form.iter().map(String::as_str));
    let mut table = ResultTable::new(names.chain(["missing", "fault"]));
    for feature in features {
        let angle = feature.quantity == Some(Quantity::Angle);
        let shown = |number: Option<f64>| value(number.map(|n| if angle { n.to_degrees() } else { n }));
        let (quantity, in_unit) = match feature.quantity {
            Some(Quantity::Distance) => ("distance", unit),
            Some(Quantity::Diameter) => ("diameter", unit),
            Some(Quantity::Angle) => ("angle", "deg"),
            None => ("", ""),
        };
        let mut row = vec![feature.id.clone(), feature.kind.clone(), feature.points.to_string()];
        row.extend([quantity.to_owned(), in_unit.to_owned(), shown(feature.value), shown(feature.sigma)]);
        row.extend(values(feature.position.map(|position| axes.shown(position))));
        row.extend(values(feature.sigma_position.map(|sigma| axes.shown(sigma))));
        row.extend(values(feature.direction.map(|direction| axes.shown(direction))));
        row.push(value(feature.sigma_direction.map(f64::to_degrees)));
        row.push(value(feature.rms));
        row.extend(values(feature.range));
        row.push(feature.missing.join(" "));
        row.push(feature.error.as_ref().map(ToString::to_string).unwrap_or_default());
        table.rows.push(row);
    }
    table
}

fn residuals(unit: &str, axes: ShownAxes, features: &[MeasuredFeature]) -> ResultTable {
    let differences = axes.names().map(|name| format!("d{name} [{unit}]"));
    let names = ["deviation", "sigma"].map(|name| format!("{name} [{unit}]")).into_iter().chain(differences);
    let names: Vec<String> = names.collect();
    let mut table = ResultTable::new(["feature", "point"].into_iter().chain(names.iter().map(String::as_str)));
    for feature in features {
        for residual in &feature.residuals {
            let mut row = vec![feature.id.clone(), residual.point.clone()];
            row.extend([value(Some(residual.value)), value(residual.sigma)]);
            row.extend(values(residual.difference.map(|difference| axes.shown(difference))));
            table.rows.push(row);
        }
    }
    table
}
