//! Image measurements as DBAT and its kin write them: photo, point, u, v and one sigma or two, in pixels, the centre of
//! the first pixel at (0.5, 0.5): the engine's own frame.

use std::fmt::Write;

use super::text;
use crate::error::{Error, Lack, Result};
use crate::matching::Mark;
use crate::project::{Observation, Sigma};

/// Sigma in pixels where the file has none.
const DEFAULT_SIGMA: f64 = 0.1;

/// Reads marks: the measurements with one sigma each, the root mean square of two.
///
/// # Errors
/// [`Error::Invalid`] with line and field, [`Error::Empty`] when there is no measurement.
pub fn parse(text: &str) -> Result<Vec<Mark>> {
    let mark = |observation: Observation| {
        let [su, sv] = observation.sigma.both();
        let Observation { photo, point, u, v, .. } = observation;
        Mark { photo, point, u, v, sigma: if su == sv { su } else { su.hypot(sv) / std::f64::consts::SQRT_2 } }
    };
    Ok(observations(text)?.into_iter().map(mark).collect())
}

/// Reads measurements; fields are separated by tabs, commas, semicolons or blanks, lines that start with # or % are comments.
///
/// # Errors
/// [`Error::Invalid`] with line and field, [`Error::Empty`] when there is no measurement.
pub fn observations(text: &str) -> Result<Vec<Observation>> {
    let mut marks = Vec::new();
    for row in text::rows(text) {
        // The first row may be a heading.
        if marks.is_empty()
            && row.fields.len() >= 4
            && row.fields[2..4].iter().all(|field| text::number(field).is_none())
        {
            continue;
        }
        let sigma = |index| row.positive(index, "sigma");
        marks.push(Observation {
            photo: text::armed(row.text(0, "photo")?).to_owned(),
            point: text::armed(row.text(1, "point")?).to_owned(),
            u: row.number(2, "u")?,
            v: row.number(3, "v")?,
            sigma: match row.fields.len() {
                0..=4 => Sigma::One(DEFAULT_SIGMA),
                5 => Sigma::One(sigma(4)?),
                _ => Sigma::Two([sigma(4)?, sigma(5)?]),
            },
            enabled: true,
            target: None,
        });
    }
    if marks.is_empty() { Err(Error::Empty { what: Lack::Observations }) } else { Ok(marks) }
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
    use crate::error::Place;
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
    fn a_wrong_line_is_named() {
        assert_eq!(parse("1,2,3,4\n1,2,x,4").unwrap_err().place(), Place::line(2).with_field("u"));
        assert_eq!(parse("1,2,3,4,0").unwrap_err().place(), Place::line(1).with_field("sigma"));
        assert_eq!(parse("# nothing\n").unwrap_err().code(), "empty");
    }
}
