//! Image measurements as DBAT and its kin write them: photo, point, u, v and one sigma or two, in pixels, the centre of
//! the first pixel at (0.5, 0.5): the engine's own frame.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use super::text::{self, Row};
use sightline::error::{Error, Lack, Place, Result};
use sightline::matching::Mark;
use sightline::project::{Observation, Sigma};

/// Sigma in pixels where the file has none.
const DEFAULT_SIGMA: f64 = 0.1;

/// Reads marks: the measurements with one sigma each, the root mean square of two.
///
/// # Errors
/// [`Error::Invalid`], with the line and the field, for text that is no measurement; [`Error::Empty`] for a text without measurements.
pub fn parse(text: &str) -> Result<Vec<Mark>> {
    let mark = |observation: Observation| {
        let [su, sv] = observation.sigma.both();
        let Observation { photo, point, u, v, .. } = observation;
        Mark { photo, point, u, v, sigma: if su == sv { su } else { su.hypot(sv) / std::f64::consts::SQRT_2 } }
    };
    Ok(observations(text)?.into_iter().map(mark).collect())
}

/// Reads measurements; fields are separated by tabs, commas, semicolons or blanks, lines that start with # or % are comments. A heading
/// that names photo, point, u and v decides their order.
///
/// # Errors
/// [`Error::Invalid`], with the line and the field, for text that is no measurement and for commas that may be decimal commas;
/// [`Error::Empty`] for a text without measurements.
pub fn observations(text: &str) -> Result<Vec<Observation>> {
    let mut rows = text::rows(text);
    // The first row may be a heading.
    // Words, not what merely is no number: "848,5" is a measurement that cannot be read, and must not go as a heading.
    let words = |fields: &[String]| fields.iter().all(|field| field.starts_with(char::is_alphabetic));
    let heading = rows.first().is_some_and(|row| row.fields.len() >= 4 && words(&row.fields[2..4]));
    let order = if heading { order(&rows.remove(0).fields) } else { None };
    let order = order.unwrap_or([0, 1, 2, 3, 4, 5]);
    if let Some(line) = separated_both_ways(text, &rows) {
        let at = Place::line(line).with_field("u");
        return Err(Error::Invalid { reason: ExchangeReason::SeparatorBothWays.into(), at });
    }
    let mut marks = Vec::new();
    for row in rows {
        let [photo, point, u, v, su, sv] = order;
        let given = |index: usize| row.fields.get(index).is_some_and(|field| !field.is_empty());
        let sigma = |index| row.positive(index, "sigma");
        marks.push(Observation {
            photo: text::armed(row.text(photo, "photo")?).to_owned(),
            point: text::armed(row.text(point, "point")?).to_owned(),
            u: row.number(u, "u")?,
            v: row.number(v, "v")?,
            sigma: match (given(su), row.fields.len() > sv) {
                (false, false) => Sigma::One(DEFAULT_SIGMA),
                (true, false) => Sigma::One(sigma(su)?),
                (_, true) => Sigma::Two([sigma(su)?, sigma(sv)?]),
            },
            enabled: true,
            target: None,
        });
    }
    if marks.is_empty() { Err(Error::Empty { what: Lack::Observations }) } else { Ok(marks) }
}

/// Columns of photo, point, u, v and their standard errors by the names of a heading; `None` if it does not name the first four.
fn order(heading: &[String]) -> Option<[usize; 6]> {
    let plain = |text: &String| {
        let name = text.split(['[', '(']).next().unwrap_or_default();
        name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect::<String>()
    };
    let names: Vec<String> = heading.iter().map(plain).collect();
    let place = |known: &[&str]| names.iter().position(|name| known.contains(&name.as_str()));
    let [photo, point, u, v] = [
        place(&["photo", "image", "img", "picture", "사진"])?,
        place(&["point", "id", "pointid", "target", "name", "점", "점번호", "점명"])?,
        place(&["u", "x", "column", "col"])?,
        place(&["v", "y", "row", "line"])?,
    ];
    // Standard errors may follow a heading that names the first four only.
    let [first, second] = if heading.len() == 4 { [4, 5] } else { [heading.len().max(6); 2] };
    let su = place(&["sigma", "sigmau", "su", "sigmax", "sx", "σ", "σu"]).unwrap_or(first);
    let sv = place(&["sigmav", "sv", "sigmay", "sy", "σv"]).unwrap_or(second);
    Some([photo, point, u, v, su, sv])
}

/// The first line whose commas may be decimal commas or thousands separators as well: it has more fields than photo, point, u and v, and
/// two of its neighbouring fields can be one number. As in [`control_csv`](super::control_csv), all such lines have to.
fn separated_both_ways(text: &str, rows: &[Row]) -> Option<usize> {
    let lines: Vec<&str> = text.lines().collect();
    let commas =
        |row: &&Row| lines.get(row.line - 1).is_some_and(|line| line.contains(',') && !line.contains([';', '\t']));
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let points = rows.iter().flat_map(|row| row.fields.iter().skip(2)).any(|field| field.contains('.'));
    let joins = |pair: &[String]| {
        let [a, b] = pair else { return false };
        let (whole, rest) = b.split_once('.').unwrap_or((b, "0"));
        let thousands = a.len() <= 3 && !a.starts_with('0') && whole.len() == 3 && digits(rest);
        digits(a) && digits(whole) && (thousands || !points)
    };
    let mut wide = rows.iter().filter(|row| row.fields.len() > 4).filter(commas).peekable();
    let first = wide.peek()?.line;
    wide.all(|row| row.fields[2..].windows(2).any(joins)).then_some(first)
}

/// Writes measurements, one a line; what is not enabled is left out.
pub fn write(observations: &[Observation]) -> String {
    let mut lines = String::from("# photo, point, u [px], v [px], sigma_u [px], sigma_v [px]\n");
    for observation in observations.iter().filter(|observation| observation.enabled) {
        let [su, sv] = observation.sigma.both();
        let Observation { photo, point, u, v, .. } = observation;
        let [photo, point] = [photo, point].map(|id| text::quoted(&text::disarmed(id), ',').into_owned());
        // A quote counts at the very beginning of a field.
        let blank = if point.starts_with('"') { "" } else { " " };
        // Writing to a string does not fail.
        let _ = writeln!(lines, "{photo},{blank}{point}, {u}, {v}, {su}, {sv}");
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn marks_are_read_and_written() {
        let marks = observations("photo, point, u, v\n 1,    2, 1429.1871, 1456.4278, 0.1\n 2 a7 3 4\n1;3;5;6;.1;.2\n")
            .unwrap();
        assert_eq!(marks.len(), 3);
        assert_eq!((marks[0].photo.as_str(), marks[0].point.as_str(), marks[0].u), ("1", "2", 1429.1871));
        assert_eq!(marks[1].sigma, Sigma::One(DEFAULT_SIGMA));
        assert_eq!(marks[2].sigma, Sigma::Two([0.1, 0.2]));
        assert!((parse("1 1 1 1 3 4").unwrap()[0].sigma - 12.5f64.sqrt()).abs() < 1e-12);
        let again = observations(&write(&marks)).unwrap();
        assert_eq!(
            again.iter().map(|mark| (mark.u, mark.sigma.both())).collect::<Vec<_>>(),
            marks.iter().map(|mark| (mark.u, mark.sigma.both())).collect::<Vec<_>>()
        );
    }

    #[test]
    fn identifiers_of_any_kind_are_read_back() {
        for id in ["5,6", "a;b", "say \"a\"", "two\nlines", "#1", "점 1", "a b"] {
            let mark = Observation {
                photo: id.into(),
                point: id.into(),
                u: 1.5,
                v: -2.0,
                sigma: Sigma::Two([0.1, 0.2]),
                enabled: true,
                target: None,
            };
            let text = write(&[mark.clone(), mark.clone()]);
            assert_eq!(observations(&text).unwrap(), [mark.clone(), mark], "{text}");
        }
    }

    #[test]
    fn tables_with_tabs_have_names_with_blanks_and_sigmas_that_are_missing() {
        let text = "photo\tpoint\tu\tv\tsigma\nP 1\t\"say \"\"a\"\"\"\t1.5\t2\t0.2\n\"P 1\"\ta b\t3\t4\t\n";
        let marks = parse(text).unwrap();
        let names: Vec<[&str; 2]> = marks.iter().map(|mark| [mark.photo.as_str(), mark.point.as_str()]).collect();
        assert_eq!(names, [["P 1", "say \"a\""], ["P 1", "a b"]]);
        assert_eq!(marks.iter().map(|mark| mark.sigma).collect::<Vec<_>>(), [0.2, DEFAULT_SIGMA]);
        assert_eq!(parse("1\t2\t3\t4\n1\t\t3\t4\n").unwrap_err().place(), Place::line(2).with_field("point"));
    }

    #[test]
    fn a_heading_decides_the_order_and_commas_are_never_two_things() {
        let text = "point;photo;y [px];x [px]\n7;a;2.5;1.5\n";
        let mark = &parse(text).unwrap()[0];
        assert_eq!((mark.photo.as_str(), mark.point.as_str(), mark.u, mark.v), ("a", "7", 1.5, 2.5));
        for open in [
            "1,2,1429,1871,1456,4278\n1,3,12,5,14,25\n",
            "1,2,848,5,514\n",
            "a,2,1,234.5,987.25\na,3,2,345.5,1,987.0\n",
        ] {
            let error = parse(open).unwrap_err();
            assert!(
                matches!(ExchangeReason::of_error(&error), Some(ExchangeReason::SeparatorBothWays)),
                "{open}: {error}"
            );
        }
        for sure in ["1,2,848,514\n", "1,2,848.0,514,0.1\n", "1 2 848 514 1\n", "1;2;848;514;1\n"] {
            assert!(parse(sure).is_ok(), "{sure}");
        }
        // A decimal comma is no number here, and a row of them is no heading.
        assert!(parse("1;2;848,5;514,25\n1;3;84;51\n1;4;85;52\n").is_err());
    }

    #[test]
    fn a_wrong_line_is_named() {
        assert_eq!(parse("1,2,3,4\n1,2,x,4").unwrap_err().place(), Place::line(2).with_field("u"));
        assert_eq!(parse("1,2,3.5,4,0").unwrap_err().place(), Place::line(1).with_field("sigma"));
        assert_eq!(parse("# nothing\n").unwrap_err().code(), "empty");
    }
}
