//! Expressions of the network's quantities for the answers of lessons, so that no answer is stored in a lesson.
//!
//! ```text
//! expression  = sum [ ("=" | "<" | ">") sum ]           1 where it holds, else 0; "=" to 1e-9 of the larger side
//! sum         = product { ("+" | "-") product }
//! product     = factor { ("*" | "/") factor }
//! factor      = ["-"] ( number | "(" expression ")" | name [ "(" words, separated by commas ")" ] )
//! ```
//!
//! Words name things of the project and are taken as they stand: `r(2 7 x)` is the redundancy number of x of point 7 in photo 2. The
//! functions `sqrt`, `abs` and `log10` take an expression. [`NAMES`] lists the quantities.

use std::cell::OnceCell;

use nalgebra::DMatrix;

use super::datums::{Datums, datums};
use super::dense::{carried, cofactors, redundancy};
use super::eccentric::biases;
use super::planted::tail;
use super::weights::scaled;
use sightline::adjust::{
    Adjuster, LinearSystem, NormalEquations, adjust, apply, at_end, linearise, normal_equations, start_adjustment,
};
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::error::Result;
use sightline::project::{DatumKind, Project};
use sightline::statistics::distribution::{critical_w, noncentrality};

/// Quantities with their arguments in brackets.
pub const NAMES: [&str; 47] = [
    "n",
    "u",
    "d",
    "redundancy",
    "photos",
    "points",
    "sigma0",
    "vtpv",
    "iterations",
    "start_sigma0",
    "start_vtpv",
    "step_sigma0(k)",
    "step_size(k)",
    "chi2_low",
    "chi2_high",
    "entries",
    "share",
    "reduced",
    "rank",
    "defect",
    "factor",
    "factor_photos_first",
    "critical",
    "noncentrality",
    "r_sum",
    "r_min",
    "r_max",
    "value(row)",
    "computed(row)",
    "l(row)",
    "sigma_of(row)",
    "weight(row)",
    "row_entries(row)",
    "a(row, unknown)",
    "r(row)",
    "w(row)",
    "mdb(row)",
    "power(row, size in sigma)",
    "sigma(point, axis)",
    "rms(axis)",
    "rays(point)",
    "parameter(camera, name)",
    "parameter_sigma(camera, name)",
    "correlation(camera, name, name)",
    "trace(datum)",
    "datum_vtpv(datum)",
    "eccentricity(diameter)",
];

/// Evaluates expressions at the adjusted values; `l`, `computed`, `a` and `start_…` at the values of the document. Also known:
/// `without(photo, expression)`, the expression's value for the network without that photo. An expression that cannot be evaluated is
/// answered with what is wrong with it. `scaled(image, control, expression)`: with the standard errors of image and control coordinates
/// times these factors. `planted(row, size, expression)`: with an error of so many standard errors in that image coordinate.
///
/// # Errors
/// As [`adjust`].
pub fn evaluate(
    project: &Project,
    options: &AdjustOptions,
    expressions: &[String],
) -> Result<Vec<std::result::Result<f64, String>>> {
    let network = Network::new(project, options)?;
    Ok(expressions.iter().map(|text| value(&network, text)).collect())
}

type Found<T = f64> = std::result::Result<T, String>;

fn value(network: &Network<'_>, text: &str) -> Found {
    let mut reader = Reader { rest: text, network };
    let value = reader.expression()?;
    match reader.rest.trim() {
        "" if value.is_finite() => Ok(value),
        "" => Err(format!("{text}: no finite value")),
        rest => Err(format!("{text}: not understood from \"{rest}\"")),
    }
}

struct Reader<'a> {
    rest: &'a str,
    network: &'a Network<'a>,
}

impl<'a> Reader<'a> {
    fn taken(&mut self, sign: char) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn expression(&mut self) -> Found {
        let left = self.sum()?;
        let holds = if self.taken('=') {
            let right = self.sum()?;
            (left - right).abs() <= 1e-9 * left.abs().max(right.abs())
        } else if self.taken('<') {
            left < self.sum()?
        } else if self.taken('>') {
            left > self.sum()?
        } else {
            return Ok(left);
        };
        Ok(f64::from(u8::from(holds)))
    }

    fn sum(&mut self) -> Found {
        let mut sum = self.product()?;
        loop {
            if self.taken('+') {
                sum += self.product()?;
            } else if self.taken('-') {
                sum -= self.product()?;
            } else {
                return Ok(sum);
            }
        }
    }

    fn product(&mut self) -> Found {
        let mut product = self.factor()?;
        loop {
            if self.taken('*') {
                product *= self.factor()?;
            } else if self.taken('/') {
                product /= self.factor()?;
            } else {
                return Ok(product);
            }
        }
    }

    fn factor(&mut self) -> Found {
        if self.taken('-') {
            return Ok(-self.factor()?);
        }
        if self.taken('(') {
            let value = self.expression()?;
            return if self.taken(')') { Ok(value) } else { Err("\")\" is missing".to_owned()) };
        }
        let rest = self.rest.trim_start();
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || "_.".contains(c))).unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        self.rest = after;
        if word.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return numeral(word);
        }
        if word.is_empty() {
            return Err(format!("a value is missing before \"{rest}\""));
        }
        if !self.rest.starts_with('(') {
            return self.network.quantity(word, &[]);
        }
        let inside = self.brackets()?;
        let number = || value(self.network, inside);
        match word {
            "sqrt" => number().map(f64::sqrt),
            "abs" => number().map(f64::abs),
            "log10" => number().map(f64::log10),
            "without" => {
                let (photo, expression) = inside.split_once(',').ok_or("without(photo, expression)")?;
                let mut project = self.network.project.clone();
                let photo = project.photos.iter_mut().find(|one| one.id == photo.trim());
                photo.ok_or_else(|| format!("{inside}: no such photo"))?.enabled = false;
                self.of_another(&project, expression)
            }
            "scaled" => {
                let (image, control, expression) = three(inside).ok_or("scaled(image, control, expression)")?;
                let project = scaled(self.network.project, numeral(image)?, numeral(control)?);
                self.of_another(&project, expression)
            }
            "planted" => {
                let (row, size, expression) = three(inside).ok_or("planted(row, size, expression)")?;
                let mut project = self.network.project.clone();
                self.network.plant(&mut project, row, numeral(size)?)?;
                self.of_another(&project, expression)
            }
            _ => {
                let words: Vec<&str> = inside.split(',').map(str::trim).collect();
                self.network.quantity(word, &words)
            }
        }
    }

    fn of_another(&self, project: &Project, expression: &str) -> Found {
        let other = Network::new(project, self.network.options).map_err(|error| error.to_string())?;
        value(&other, expression.trim())
    }

    /// Text between matching brackets.
    fn brackets(&mut self) -> Found<&'a str> {
        let mut depth = 0;
        for (place, c) in self.rest.char_indices() {
            depth += i32::from(c == '(') - i32::from(c == ')');
            if depth == 0 {
                let inside = &self.rest[1..place];
                self.rest = &self.rest[place + 1..];
                return Ok(inside);
            }
        }
        Err("\")\" is missing".to_owned())
    }
}

/// Two words and an expression, which may have commas of its own.
fn three(inside: &str) -> Option<(&str, &str, &str)> {
    let (one, rest) = inside.split_once(',')?;
    let (two, expression) = rest.split_once(',')?;
    Some((one.trim(), two.trim(), expression))
}

fn numeral(word: &str) -> Found {
    word.parse().map_err(|_| format!("\"{word}\" is no number"))
}

/// A network with what is computed of it on demand.
struct Network<'a> {
    project: &'a Project,
    options: &'a AdjustOptions,
    start: LinearSystem,
    start_normal: NormalEquations,
    adjustment: Adjustment,
    system: LinearSystem,
    q: OnceCell<Option<DMatrix<f64>>>,
    datums: OnceCell<Option<Datums>>,
    adjuster: OnceCell<Option<Adjuster>>,
}

impl<'a> Network<'a> {
    fn new(project: &'a Project, options: &'a AdjustOptions) -> Result<Self> {
        let adjustment = adjust(project, options, &mut |_| true)?;
        let system = at_end(project, options)?.linear_system()?;
        Ok(Self {
            project,
            options,
            start: linearise(project, options)?,
            start_normal: normal_equations(project, options)?,
            adjustment,
            system,
            q: OnceCell::new(),
            datums: OnceCell::new(),
            adjuster: OnceCell::new(),
        })
    }

    fn row(&self, name: &str) -> Found<usize> {
        let found = self.system.observations.iter().position(|row| row.name == name);
        found.ok_or_else(|| format!("no observation \"{name}\""))
    }

    /// Puts an error into an image coordinate; its sign is that of photo coordinates, whose y points up where pixels' points down.
    fn plant(&self, project: &mut Project, row: &str, size: f64) -> Found<()> {
        let equation = &self.system.observations[self.row(row)?];
        let found = project
            .observations
            .iter_mut()
            .find(|one| Some(&one.photo) == equation.photo.as_ref() && Some(&one.point) == equation.point.as_ref());
        let observation =
            found.filter(|_| equation.given.is_none()).ok_or_else(|| format!("{row}: no image coordinate"))?;
        let [u, v] = observation.sigma.both();
        if equation.axis.as_deref() == Some("x") {
            observation.u += size * u
        } else {
            observation.v -= size * v
        }
        Ok(())
    }

    fn q(&self) -> Found<&DMatrix<f64>> {
        self.q.get_or_init(|| cofactors(&self.system)).as_ref().ok_or_else(|| "too many unknowns".to_owned())
    }

    fn redundancy(&self, row: usize) -> Found {
        Ok(redundancy(&self.system, &carried(&self.system, self.q()?, row), row))
    }

    fn redundancies(&self) -> Found<Vec<f64>> {
        (0..self.system.observations.len()).map(|row| self.redundancy(row)).collect()
    }

    fn datum(&self, name: &str) -> Found<&super::DatumCase> {
        let kind = match name {
            "control" => DatumKind::Control,
            "minimal" => DatumKind::Minimal,
            "free" => DatumKind::Free,
            _ => return Err(format!("no datum \"{name}\"")),
        };
        let all = self.datums.get_or_init(|| datums(self.project, self.options, None).ok()).as_ref();
        let case = all.and_then(|all| all.cases.iter().find(|case| case.kind == kind && !case.points.is_empty()));
        case.ok_or_else(|| format!("no result under the datum \"{name}\""))
    }

    fn step(&self, k: &str) -> Found<sightline::adjust::StepState> {
        let k: usize = k.parse().map_err(|_| format!("\"{k}\" is no step"))?;
        let begun = self.adjuster.get_or_init(|| start_adjustment(self.project, self.options).ok());
        let mut adjuster = begun.clone().ok_or("no steps")?;
        for _ in 0..k {
            adjuster.step().map_err(|error| error.to_string())?;
        }
        Ok(adjuster.state().clone())
    }

    fn quantity(&self, name: &str, words: &[&str]) -> Found {
        let a = &self.adjustment;
        let count = |count: usize| Ok(count as f64);
        let need = |value: Option<f64>| value.ok_or_else(|| format!("{name}: not known of this network"));
        let camera = |id: &str| a.cameras.iter().find(|one| one.camera.id == id).ok_or(format!("no camera \"{id}\""));
        let axis = |axis: &str| {
            let place = ["X", "Y", "Z"].iter().position(|one| *one == axis);
            place.ok_or_else(|| format!("no axis \"{axis}\""))
        };
        let sum_squares =
            |system: &LinearSystem| -> f64 { system.l.iter().zip(&system.p).map(|(l, p)| l * l * p).sum() };
        match (name, words) {
            ("n", []) => count(a.observations_count),
            ("u", []) => count(a.unknowns),
            ("d", []) => count(a.constraints),
            ("redundancy", []) => count(a.redundancy),
            ("photos", []) => count(a.photos.len()),
            ("points", []) => count(a.points.len()),
            ("iterations", []) => count(a.iterations.len()),
            ("sigma0", []) => need(a.sigma0),
            ("vtpv", []) => Ok(sum_squares(&self.system)),
            ("start_vtpv", []) => Ok(sum_squares(&self.start)),
            ("start_sigma0", []) => Ok((sum_squares(&self.start) / a.redundancy as f64).sqrt()),
            ("step_sigma0", [k]) => need(self.step(k)?.sigma0),
            ("step_size", [k]) => need(self.step(k)?.iteration.map(|iteration| iteration.step)),
            ("chi2_low", []) => need(a.global_test.as_ref().map(|test| test.lower)),
            ("chi2_high", []) => need(a.global_test.as_ref().map(|test| test.upper)),
            ("entries", []) => count(self.start.a.values.len()),
            ("share", []) => Ok(self.start.a.values.len() as f64 / (self.start.a.rows * self.start.a.columns) as f64),
            ("reduced", []) => count(self.start_normal.reduced.unknowns.len()),
            ("rank", []) => count(self.start_normal.rank),
            ("defect", []) => {
                self.datum("free")?;
                count(self.datums.get().and_then(Option::as_ref).map_or(0, |all| all.motions.len()))
            }
            ("factor", []) => count(self.start_normal.fill_in.factor),
            ("factor_photos_first", []) => count(self.start_normal.fill_in.factor_photos_first),
            ("critical", []) => Ok(critical_w()),
            ("noncentrality", []) => Ok(noncentrality()),
            ("r_sum", []) => Ok(self.redundancies()?.iter().sum()),
            ("r_min", []) => Ok(self.redundancies()?.into_iter().fold(f64::INFINITY, f64::min)),
            ("r_max", []) => Ok(self.redundancies()?.into_iter().fold(0.0, f64::max)),
            ("value", [row]) => Ok(self.start.observations[self.row(row)?].value),
            ("computed", [row]) => self.row(row).map(|row| self.start.observations[row].value - self.start.l[row]),
            ("l", [row]) => Ok(self.start.l[self.row(row)?]),
            ("sigma_of", [row]) => Ok(self.start.observations[self.row(row)?].sigma),
            ("weight", [row]) => Ok(self.start.p[self.row(row)?]),
            ("row_entries", [row]) => count(self.start.a.row(self.row(row)?).count()),
            ("a", [row, unknown]) => {
                let column = self.start.unknowns.iter().position(|one| one.name == *unknown);
                let column = column.ok_or_else(|| format!("no unknown \"{unknown}\""))?;
                Ok(self.start.a.row(self.row(row)?).find(|entry| entry.0 == column).map_or(0.0, |entry| entry.1))
            }
            ("r", [row]) => self.redundancy(self.row(row)?),
            ("w", [row]) => {
                let row = self.row(row)?;
                Ok(-self.system.l[row] * self.system.p[row].sqrt() / self.redundancy(row)?.sqrt())
            }
            ("mdb", [row]) => Ok(noncentrality() / self.redundancy(self.row(row)?)?.sqrt()),
            ("power", [row, size]) => {
                let shift = numeral(size)? * self.redundancy(self.row(row)?)?.sqrt();
                Ok(tail(critical_w() - shift) + tail(critical_w() + shift))
            }
            ("sigma", [point, on]) => {
                let point = a.points.iter().find(|one| one.id == *point).ok_or(format!("no point \"{point}\""))?;
                let axis = axis(on)?;
                need(point.sigma.map(|sigma| sigma[axis]))
            }
            ("rms", [on]) => {
                let axis = axis(on)?;
                need(a.precision.as_ref().map(|precision| precision.rms_sigma[axis]))
            }
            ("rays", [point]) => {
                let point = a.points.iter().find(|one| one.id == *point).ok_or(format!("no point \"{point}\""))?;
                count(point.rays)
            }
            ("parameter", [id, parameter]) => {
                let camera = camera(id)?;
                let interior = &camera.camera.interior;
                let named = interior.parameters().iter().find(|one| one.name() == *parameter);
                need(named.and_then(|one| interior.get(*one)))
            }
            ("parameter_sigma", [id, parameter]) => {
                let camera = camera(id)?;
                need(camera.sigma.iter().find(|(one, _)| one.name() == *parameter).map(|(_, sigma)| *sigma))
            }
            ("correlation", [id, one, other]) => {
                let correlation = &camera(id)?.correlation;
                let place = |name: &str| correlation.names.iter().position(|known| known == name);
                need(place(one).zip(place(other)).map(|(i, j)| correlation.matrix[i][j]))
            }
            ("trace", [datum]) => Ok(self.datum(datum)?.trace),
            ("datum_vtpv", [datum]) => Ok(self.datum(datum)?.weighted_squares),
            ("eccentricity", [diameter]) => {
                let diameter = numeral(diameter)?;
                let adjusted = apply(self.project, a);
                let found = biases(&adjusted, self.options, &[diameter]).map_err(|error| error.to_string())?;
                Ok(found[0].in_sigma)
            }
            _ => Err(format!("no quantity \"{name}\" with {} words", words.len())),
        }
    }
}
