//! Texts with values: `{n}` is a value, `{n:one|other}` one of two forms, chosen by it as the language does.

use std::fmt::Display;

/// How a language chooses between two forms by the value they go with.
pub type Choose = for<'a> fn(&str, &'a str, &'a str) -> &'a str;

/// Puts values into a template; the test of all texts has every template parsed.
pub fn fill(template: &str, values: &[(&str, &dyn Display)], choose: Choose) -> String {
    let mut text = String::with_capacity(template.len() + 16);
    let mut rest = template;
    while let Some(start) = rest.find('{') {
        let Some(end) = rest[start..].find('}') else { break };
        text.push_str(&rest[..start]);
        let (name, forms) = parts(&rest[start + 1..start + end]);
        if let Some((_, value)) = values.iter().find(|(known, _)| *known == name) {
            let value = value.to_string();
            text.push_str(forms.map_or(value.as_str(), |(one, other)| choose(&value, one, other)));
        }
        rest = &rest[start + end + 1..];
    }
    text.push_str(rest);
    text
}

/// A name, with the two forms that it chooses between.
fn parts(inner: &str) -> (&str, Option<(&str, &str)>) {
    match inner.split_once(':') {
        Some((name, forms)) => (name, forms.split_once('|')),
        None => (inner, None),
    }
}

/// The names of the values that a template uses, or what is wrong with it.
pub fn values(template: &str) -> Result<std::collections::BTreeSet<String>, String> {
    let mut names = std::collections::BTreeSet::new();
    let mut rest = template;
    while let Some(start) = rest.find('{') {
        let end = rest[start..].find('}').ok_or("a brace is not closed")?;
        let inner = &rest[start + 1..start + end];
        let (name, forms) = parts(inner);
        if name.is_empty() || (inner.contains(':') && forms.is_none()) {
            return Err(format!("{{{inner}}} is no value"));
        }
        names.insert(name.to_owned());
        rest = &rest[start + end + 1..];
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn plural<'a>(value: &str, one: &'a str, other: &'a str) -> &'a str {
        if value == "1" { one } else { other }
    }

    #[test]
    fn values_and_forms_are_put_in() {
        let told = |n: usize| fill("{n} {n:photo|photos} of {x}.", &[("n", &n), ("x", &"a{b}")], plural);
        assert_eq!(told(1), "1 photo of a{b}.");
        assert_eq!(told(21), "21 photos of a{b}.");
        assert_eq!(fill("all {n:one|many", &[("n", &1)], plural), "all {n:one|many");
    }

    #[test]
    fn broken_templates_are_found() {
        assert_eq!(values("{a} {b:x|y} {a}").map(|v| v.len()), Ok(2));
        assert!(values("{a").is_err() && values("{a:x}").is_err() && values("{}").is_err());
    }
}
