//! YAML, JSON and OpenCV's XML as one tree, whose nodes know their path: errors name the element and what was expected there.

use crate::reason::ExchangeReason;
use saphyr_parser::{Event, Parser, ScalarStyle};
use serde_json::{Map, Value};

use super::dbat::element::{self, Element};
use sightline::error::{Error, Place, Reason, Result, shortened};

/// Deepest nesting that is followed: files of calibrations are nested less than 10 deep, and a tree is built and dropped by recursion.
const DEPTH_LIMIT: usize = 64;

/// A place in a tree.
#[derive(Clone, Debug)]
pub struct Node<'a> {
    path: String,
    /// What stands there.
    pub value: &'a Value,
}

impl<'a> Node<'a> {
    /// The whole tree.
    pub fn root(value: &'a Value) -> Self {
        Self { path: String::new(), value }
    }

    /// An error at this place.
    pub fn invalid(&self, reason: Reason) -> Error {
        Error::Invalid { reason, at: Place::field(self.path.clone()) }
    }

    /// An error with the expected content at this place.
    pub fn expected(&self, expected: &str) -> Error {
        let found = match self.value {
            Value::String(text) => text.clone(),
            Value::Array(items) => format!("a list of {}", items.len()),
            Value::Object(fields) => format!("a group of {}", fields.len()),
            other => other.to_string(),
        };
        self.invalid(ExchangeReason::ExpectedHere { expected: expected.into(), found: shortened(&found) }.into())
    }

    fn below(&self, name: &str) -> String {
        if self.path.is_empty() { name.to_owned() } else { format!("{}.{name}", self.path) }
    }

    /// A field, if it is there.
    pub fn get(&self, name: &str) -> Option<Self> {
        let value = self.value.get(name).filter(|value| !value.is_null())?;
        Some(Self { path: self.below(name), value })
    }

    /// The first of several names that is there.
    pub fn any(&self, names: &[&str]) -> Option<Self> {
        names.iter().find_map(|name| self.get(name))
    }

    /// A field that has to be there.
    pub fn need(&self, name: &str) -> Result<Self> {
        let missing =
            || Error::Invalid { reason: Reason::Missing { name: name.into() }, at: Place::field(self.below(name)) };
        self.get(name).ok_or_else(missing)
    }

    /// Names of the fields; none of what is no group.
    pub fn names(&self) -> Vec<&'a str> {
        self.value.as_object().into_iter().flat_map(Map::keys).map(String::as_str).collect()
    }

    /// Items of a list; an empty text counts as an empty list, as Boost writes it.
    pub fn items(&self) -> Result<Vec<Self>> {
        let items = match self.value {
            Value::Array(items) => items.as_slice(),
            Value::String(text) if text.trim().is_empty() => &[],
            _ => return Err(self.expected("a list")),
        };
        Ok(items.iter().enumerate().map(|(k, value)| Self { path: format!("{}[{k}]", self.path), value }).collect())
    }

    /// A finite number; programs write some of them as text.
    pub fn number(&self) -> Result<f64> {
        let number = match self.value {
            Value::Number(number) => number.as_f64(),
            Value::String(text) => number(text.trim()),
            _ => None,
        };
        number.filter(|number| number.is_finite()).ok_or_else(|| self.expected("a number"))
    }

    /// A number that must be above 0.
    pub fn positive(&self) -> Result<f64> {
        let number = self.number()?;
        if number > 0.0 { Ok(number) } else { Err(self.expected("a number above 0")) }
    }

    /// A size in pixels, from 1.
    pub fn size(&self) -> Result<u32> {
        let number = self.number()?;
        let fits = number.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&number);
        if fits { Ok(number as u32) } else { Err(self.expected("a whole number of pixels from 1")) }
    }

    /// A text; numbers count as their text, since identifiers may be either.
    pub fn text(&self) -> Result<String> {
        match self.value {
            Value::String(text) => Ok(text.clone()),
            Value::Number(number) => Ok(number.to_string()),
            _ => Err(self.expected("a text")),
        }
    }

    /// Numbers of a list or of a text with blanks between them.
    pub fn numbers(&self) -> Result<Vec<f64>> {
        if let Value::String(text) = self.value {
            let found: Option<Vec<f64>> = text.split_whitespace().map(number).collect();
            return found.ok_or_else(|| self.expected("numbers"));
        }
        self.items()?.iter().map(Self::number).collect()
    }

    /// So many numbers.
    pub fn exactly<const N: usize>(&self) -> Result<[f64; N]> {
        let found = self.numbers()?;
        found.try_into().map_err(|found: Vec<f64>| {
            let found = format!("{} numbers", found.len());
            self.invalid(ExchangeReason::ExpectedHere { expected: format!("{N} numbers"), found }.into())
        })
    }

    /// Rows, columns and numbers of a matrix: `rows`, `cols`, `data`, as OpenCV and ROS write it, or a plain list of numbers as one row.
    pub fn matrix(&self) -> Result<(usize, usize, Vec<f64>)> {
        if self.value.is_array() {
            let numbers = self.numbers()?;
            return Ok((1, numbers.len(), numbers));
        }
        let count = |name: &str| -> Result<usize> {
            let node = self.need(name)?;
            let number = node.number()?;
            let fits = number.fract() == 0.0 && (0.0..1e6).contains(&number);
            if fits { Ok(number as usize) } else { Err(node.expected("a number of rows or columns")) }
        };
        let (rows, columns) = (count("rows")?, count("cols")?);
        let data = self.need("data")?;
        let numbers = data.numbers()?;
        if numbers.len() != rows * columns {
            let (expected, found) = (format!("{} numbers", rows * columns), format!("{} numbers", numbers.len()));
            return Err(data.invalid(ExchangeReason::ExpectedHere { expected, found }.into()));
        }
        Ok((rows, columns, numbers))
    }
}

/// A number with a decimal point; words such as "inf" are none.
pub fn number(text: &str) -> Option<f64> {
    let plain = text.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.' | b'e' | b'E'));
    if plain { text.parse().ok().filter(|number: &f64| number.is_finite()) } else { None }
}

/// A number as every reader takes it for one of floating point: with a point, and a sign in the exponent.
pub fn real(value: f64) -> String {
    let text = format!("{value:?}");
    match text.split_once('e') {
        None => text,
        Some((digits, exponent)) => {
            let point = if digits.contains('.') { "" } else { ".0" };
            let sign = if exponent.starts_with('-') { "" } else { "+" };
            format!("{digits}{point}e{sign}{exponent}")
        }
    }
}

/// JSON, YAML or OpenCV's XML, by its beginning.
///
/// # Errors
/// [`Error::Invalid`] with line or element.
pub fn parse(text: &str) -> Result<Value> {
    let start = text.trim_start();
    if start.starts_with('<') {
        return element::parse(text).map(|root| from_element(&root));
    }
    if start.starts_with('{') { json(text) } else { yaml(text) }
}

/// JSON.
pub fn json(text: &str) -> Result<Value> {
    serde_json::from_str(text).map_err(|error| Error::Invalid {
        reason: ExchangeReason::ExpectedHere { expected: "JSON".into(), found: shortened(&error.to_string()) }.into(),
        at: Place::line(error.line()),
    })
}

/// The first document of a YAML; OpenCV's directive `%YAML:1.0` is skipped.
pub fn yaml(text: &str) -> Result<Value> {
    // The end of the directive's line stays, so that the others keep their numbers.
    let text = text.strip_prefix("%YAML").map_or(text, |rest| rest.find('\n').map_or("", |end| &rest[end..]));
    let damaged = |message: &str, line: usize| Error::Invalid {
        reason: ExchangeReason::DamagedYaml { message: shortened(message) }.into(),
        at: Place::line(line),
    };
    /// A list or group that is open, with the name under which it will stand.
    enum Open {
        List(Vec<Value>),
        Group(Map<String, Value>, Option<String>),
    }
    let mut open: Vec<Open> = Vec::new();
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| damaged(error.info(), error.marker().line()))?;
        let line = span.start.line();
        let value = match event {
            Event::SequenceStart(..) | Event::MappingStart(..) => {
                if open.len() == DEPTH_LIMIT {
                    return Err(damaged(&format!("it is nested deeper than {DEPTH_LIMIT}"), line));
                }
                open.push(match event {
                    Event::SequenceStart(..) => Open::List(Vec::new()),
                    _ => Open::Group(Map::new(), None),
                });
                continue;
            }
            Event::SequenceEnd | Event::MappingEnd => match open.pop() {
                Some(Open::List(items)) => Value::Array(items),
                Some(Open::Group(fields, _)) => Value::Object(fields),
                None => continue,
            },
            Event::Scalar(text, style, ..) => scalar(&text, style),
            Event::Alias(_) => return Err(damaged("aliases are not supported", line)),
            Event::DocumentEnd => break,
            _ => continue,
        };
        match open.last_mut() {
            None => return Ok(value),
            Some(Open::List(items)) => items.push(value),
            Some(Open::Group(fields, name)) => match name.take() {
                None => {
                    let key = match value {
                        Value::String(key) => key,
                        Value::Number(key) => key.to_string(),
                        other => return Err(damaged(&format!("a name is expected, not {other}"), line)),
                    };
                    if fields.contains_key(&key) {
                        return Err(damaged(&format!("\"{key}\" occurs twice"), line));
                    }
                    *name = Some(key);
                }
                Some(key) => {
                    fields.insert(key, value);
                }
            },
        }
    }
    Err(damaged("it is empty", 1))
}

fn scalar(text: &str, style: ScalarStyle) -> Value {
    if !matches!(style, ScalarStyle::Plain) {
        return Value::String(text.to_owned());
    }
    if let Ok(whole) = text.parse::<i64>() {
        return whole.into();
    }
    match text {
        "" | "~" | "null" => Value::Null,
        "true" | "True" => true.into(),
        "false" | "False" => false.into(),
        _ => number(text).map_or_else(|| Value::String(text.to_owned()), Value::from),
    }
}

/// Elements as fields; `_` and names that occur again are items of a list. An element without children is its text.
fn from_element(element: &Element) -> Value {
    if element.children.is_empty() {
        return Value::String(element.text.trim_matches('"').to_owned());
    }
    if element.children.iter().all(|child| child.name == "_") {
        return Value::Array(element.children.iter().map(from_element).collect());
    }
    let mut fields = Map::new();
    for child in &element.children {
        let value = from_element(child);
        match fields.get_mut(&child.name) {
            None => {
                fields.insert(child.name.clone(), value);
            }
            Some(Value::Array(items)) => items.push(value),
            Some(other) => *other = Value::Array(vec![other.take(), value]),
        }
    }
    Value::Object(fields)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn one_matrix_in_three_syntaxes() {
        let yaml = "%YAML:1.0\n---\nK: !!opencv-matrix\n   rows: 1\n   cols: 3\n   dt: d\n   data: [ 5.35e+02, 0.,\n       -1 ]\n";
        let xml = "<?xml version=\"1.0\"?>\n<opencv_storage><K type_id=\"opencv-matrix\"><rows>1</rows><cols>3</cols><dt>d</dt>\n\
                   <data>5.35e+02 0. -1</data></K></opencv_storage>";
        let json = r#"{"K": {"type_id": "opencv-matrix", "rows": 1, "cols": 3, "dt": "d", "data": [535.0, 0.0, -1]}}"#;
        for text in [yaml, xml, json] {
            let tree = parse(text).unwrap();
            let matrix = Node::root(&tree).need("K").unwrap().matrix().unwrap();
            assert_eq!(matrix, (1, 3, vec![535.0, 0.0, -1.0]), "{text}");
        }
    }

    #[test]
    fn damage_is_named_by_line_or_element() {
        assert!(parse("a: 1\nb: [1, 2\nc: 3\n").unwrap_err().place().line.is_some());
        let tree = parse("a:\n  b: [1, zwei]\n").unwrap();
        let list = Node::root(&tree).need("a").unwrap().need("b").unwrap();
        assert_eq!(list.numbers().unwrap_err().place(), Place::field("a.b[1]"));
        assert_eq!(Node::root(&tree).need("a").unwrap().need("c").unwrap_err().place(), Place::field("a.c"));
        assert!(parse(&"[".repeat(100_000)).is_err());
        assert!(parse(&"- ".repeat(100_000)).is_err());
        assert!(parse(&"{a: ".repeat(100_000)).is_err());
        assert!(parse(&"{\"a\": ".repeat(100_000)).is_err());
        assert!(parse("a: &x 1\nb: *x\n").is_err());
        assert!(parse("").is_err());
    }

    #[test]
    fn numbers_are_written_as_numbers_of_floating_point() {
        for (value, text) in [(1.0, "1.0"), (1e-7, "1.0e-7"), (1.5e300, "1.5e+300"), (-0.1, "-0.1")] {
            assert_eq!(real(value), text);
            assert_eq!(number(text), Some(value));
        }
        assert_eq!(number("inf"), None);
        assert_eq!(number("1e999"), None);
    }
}
