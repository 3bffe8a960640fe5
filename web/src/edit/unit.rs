//! The unit of length: numbers converted to another one, or another name for the numbers as they are.

use sightline::Error;
use sightline::project::scaled;
use sightline::units::{self, Unit};

use crate::document::Document;

/// Whether anything of the document is a length, so that another unit is a question.
pub fn holds_lengths(document: &Document) -> bool {
    document.options.target_diameter.is_some() || document.project.holds_lengths()
}

/// Converts every length to a unit. The result, whose numbers are in the unit before, goes.
///
/// # Errors
/// For an unknown unit before, and for lengths that leave the range of numbers; then nothing is changed.
pub fn convert(document: &mut Document, unit: Unit) -> Result<(), Error> {
    let factor = units::factor(&document.project.unit, unit.symbol())?;
    let diameter = document.options.target_diameter.map(|diameter| scaled(diameter, factor)).transpose()?;
    let project = document.project.scaled(factor)?;
    *document.project_mut() = project;
    document.options.target_diameter = diameter;
    document.result = None;
    relabel(document, unit);
    Ok(())
}

/// Gives the numbers another unit: they were in it all along.
pub fn relabel(document: &mut Document, unit: Unit) {
    let project = document.project_mut();
    project.unit = unit.symbol().to_owned();
    if let Some(plan) = &mut project.plan {
        plan.lens.unit_mm = unit.millimetres();
    }
}

#[cfg(test)]
mod tests {
    use sightline::project::{Distance, Plan, Point};

    use super::*;

    fn document(unit: &str) -> Document {
        let mut d = Document::default();
        let project = d.project_mut();
        project.unit = unit.to_owned();
        project.points.push(Point { id: "1".into(), xyz: Some([565.0, -2.0, 0.5]), ..Point::default() });
        project.distances.push(Distance { from: "1".into(), to: "2".into(), length: 565.0, sigma: 0.25, check: false });
        project.plan = Some(Box::new(Plan::default()));
        d.options.target_diameter = Some(8.0);
        d
    }

    #[test]
    fn numbers_are_converted_or_only_named_otherwise() {
        let mut d = document("mm");
        convert(&mut d, Unit::Metre).expect("known units");
        assert_eq!((d.project.unit.as_str(), d.project.distances[0].length), ("m", 0.565));
        assert_eq!(d.project.points[0].xyz, Some([0.565, -0.002, 0.0005]));
        assert_eq!(d.options.target_diameter, Some(0.008));
        assert_eq!(d.project.plan.as_ref().map(|plan| plan.lens.unit_mm), Some(1000.0));
        let mut d = document("mm");
        relabel(&mut d, Unit::Metre);
        assert_eq!((d.project.unit.as_str(), d.project.distances[0].length), ("m", 565.0));
        assert_eq!(d.options.target_diameter, Some(8.0));
        assert_eq!(d.project.plan.as_ref().map(|plan| plan.lens.unit_mm), Some(1000.0));
    }

    #[test]
    fn what_cannot_be_converted_changes_nothing() {
        for (unit, length) in [("banana", 1.0), ("km", 1e99)] {
            let mut d = document(unit);
            d.project_mut().distances[0].length = length;
            let before = d.project.clone();
            assert!(convert(&mut d, Unit::Micrometre).is_err(), "{unit}");
            assert_eq!((&d.project, d.options.target_diameter), (&before, Some(8.0)));
        }
        // A unit by another of its names is no change of the numbers.
        let mut d = document("metre");
        convert(&mut d, Unit::Metre).expect("a name of the metre");
        assert_eq!((d.project.unit.as_str(), d.project.distances[0].length), ("m", 565.0));
        assert!(holds_lengths(&d) && !holds_lengths(&Document::default()));
    }
}
