//! Points of LandXML, in and out: `CgPoint` elements with north, east, elevation as their text, in the linear unit of `Units`.
//!
//! Names are `name`, or `oID` where there is none; `code` or `desc` describe. A point that refers to another one (`pntRef`) is counted. The
//! unit's names are those of the schema: "USSurveyFoot" is 1200/3937 m, "foot" the international one.
//!
//! Source: LandXML.org, schema 1.2 (`CgPoint`, `Metric`, `Imperial`).

use crate::reason::ExchangeReason;
use std::fmt::Write;

use super::{Beside, Listed, point, tag_lines};
use crate::dbat::element::{Element, parse};
use crate::results::digits;
use crate::spatial::Spatial;
use sightline::adjustment::Adjustment;
use sightline::error::{Error, Place, Reason, Result};
use sightline::project::{Project, Role};
use sightline::units::Unit;

/// Names of units, the group that has them.
const UNITS: [(&str, &str, Unit); 9] = [
    ("Metric", "meter", Unit::Metre),
    ("Metric", "millimeter", Unit::Millimetre),
    ("Metric", "centimeter", Unit::Centimetre),
    ("Metric", "kilometer", Unit::Kilometre),
    ("Imperial", "foot", Unit::Foot),
    ("Imperial", "USSurveyFoot", Unit::SurveyFoot),
    ("Imperial", "inch", Unit::Inch),
    // Not of the schema, but written.
    ("Metric", "metre", Unit::Metre),
    ("Imperial", "yard", Unit::Yard),
];

/// Whether the document's element is LandXML.
pub(super) fn recognises(text: &str) -> bool {
    text.trim_start().starts_with('<') && !tag_lines(text.get(..4096).unwrap_or(text), "LandXML").is_empty()
}

fn collect<'a>(element: &'a Element, into: &mut Vec<&'a Element>) {
    for child in &element.children {
        if child.name == "CgPoint" {
            into.push(child);
        }
        collect(child, into);
    }
}

/// Reads the points.
pub(super) fn read(text: &str) -> Result<Listed> {
    let root = parse(text)?;
    let mut points = Vec::new();
    collect(&root, &mut points);
    let lines = tag_lines(text, "CgPoint");
    let groups = root.children("Units").flat_map(|units| &units.children);
    let named = groups.filter_map(|group| group.attribute("linearUnit")).next();
    let unit = named.and_then(|name| UNITS.iter().find(|unit| unit.1 == name)).map(|unit| unit.2);
    let mut listed = Listed { unit, repeats: true, ..Listed::default() };
    let mut references = 0;
    for (k, found) in points.iter().enumerate() {
        let line = if lines.len() == points.len() { lines[k] } else { k + 1 };
        let attribute = |name: &str| found.attribute(name).unwrap_or_default();
        if !attribute("pntRef").is_empty() && found.text.is_empty() {
            references += 1;
            continue;
        }
        let words: Vec<&str> = found.text.split_whitespace().collect();
        if words.len() > 3 {
            let reason = ExchangeReason::MoreFields { fields: words.len(), columns: 3 }.into();
            listed.rows.push(Err(Error::Invalid { reason, at: Place::line(line) }));
            continue;
        }
        let word = |k: usize| words.get(k).copied().unwrap_or_default();
        let either = |first: &str, second: &str| {
            let found = attribute(first);
            if found.is_empty() { attribute(second).to_owned() } else { found.to_owned() }
        };
        let (id, label) = (either("name", "oID"), either("code", "desc"));
        listed.rows.push(point(line, id.trim(), &label, [word(1), word(0), word(2)], 1.0));
    }
    listed.beside.push((Beside::References, references));
    Ok(listed)
}

/// Text or an attribute's value; control characters, which XML does not have, as blanks.
fn escaped(text: &str) -> String {
    let plain: String =
        text.chars().map(|c| if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') { ' ' } else { c }).collect();
    quick_xml::escape::escape(plain.as_str()).into_owned()
}

/// `points.xml`: every point that has coordinates, adjusted where there is an adjustment, to the digits of its standard error.
///
/// # Errors
/// [`Reason::NoneOf`] for a project whose unit LandXML does not have.
pub fn write(project: &Project, adjustment: Option<&Adjustment>) -> Result<String> {
    let own = Unit::named(&project.unit);
    // Units that the schema does not have are written as the nearest that it has.
    let (unit, factor) = match own {
        Some(Unit::Micrometre | Unit::Decimetre) => {
            (Unit::Millimetre, own.map_or(1.0, |own| own.factor(Unit::Millimetre)))
        }
        Some(Unit::Yard) => (Unit::Foot, 3.0),
        Some(own) => (own, 1.0),
        None => {
            let (name, choices, text) = ("unit".to_owned(), Unit::list(), project.unit.clone());
            return Err(Error::Invalid { reason: Reason::NoneOf { name, choices, text }, at: Place::field("unit") });
        }
    };
    let (group, name) =
        UNITS.iter().find(|known| known.2 == unit).map_or(("Metric", "meter"), |known| (known.0, known.1));
    let (area, volume) = match (group, name) {
        ("Metric", "meter" | "kilometer") => ("squareMeter", "cubicMeter"),
        ("Metric", "centimeter") => ("squareCentimeter", "cubicMeter"),
        ("Metric", _) => ("squareMillimeter", "cubicMeter"),
        (_, "inch") => ("squareInch", "cubicFeet"),
        _ => ("squareFoot", "cubicFeet"),
    };
    let (temperature, pressure) = if group == "Metric" { ("celsius", "mmHG") } else { ("fahrenheit", "inHG") };
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    text.push_str("<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\" version=\"1.2\" date=\"1970-01-01\" time=\"00:00:00\" language=\"English\" readOnly=\"false\">\n");
    // Writing into a string does not fail.
    let _ = writeln!(
        text,
        "  <Units><{group} linearUnit=\"{name}\" areaUnit=\"{area}\" volumeUnit=\"{volume}\" temperatureUnit=\"{temperature}\" pressureUnit=\"{pressure}\" angularUnit=\"decimal degrees\" directionUnit=\"decimal degrees\"/></Units>"
    );
    let _ = writeln!(text, "  <Project name=\"{}\"/>", escaped(&project.name));
    text.push_str("  <Application name=\"Sightline\"/>\n  <CgPoints>\n");
    for spot in &Spatial::of(project, adjustment).spots {
        let role = match spot.point.role {
            Role::Tie => "tie",
            Role::Control => "control",
            Role::Check => "check",
        };
        let [x, y, z] =
            std::array::from_fn(|k| digits(spot.xyz[k] * factor, spot.sigma.map(|sigma| sigma[k] * factor)));
        let _ =
            writeln!(text, "    <CgPoint name=\"{}\" desc=\"{role}\">{y} {x} {z}</CgPoint>", escaped(&spot.point.id));
    }
    text.push_str("  </CgPoints>\n</LandXML>\n");
    Ok(text)
}
