//! The head of the first page: what was measured, by whom and when, and a picture of it.

use crate::context::Context;
use crate::html::{Html, escaped};
use crate::number::{count, fixed, three_digits};
use crate::plots::network;

pub fn write(context: &Context, html: &mut Html) {
    let (words, settings, adjustment) = (context.words, context.settings(), context.adjustment);
    html.open("header", "");
    if !settings.logo.is_empty() {
        html.raw(&format!("<img class=\"logo\" src=\"{}\" alt=\"\">\n", escaped(&settings.logo)));
    }
    html.element("h1", "", context.title());
    let who = [
        Some((words.operator(), settings.operator.trim())),
        Some((words.date(), settings.date.trim())),
        Some((words.project(), context.project.name.trim())).filter(|_| context.title() != context.project.name.trim()),
    ];
    let who: Vec<_> = who.into_iter().flatten().filter(|(_, value)| !value.is_empty()).collect();
    let who: Vec<String> = who.into_iter().map(|(name, value)| format!("{name}: {value}")).collect();
    if !who.is_empty() {
        html.element("p", "note", &who.join("   ·   "));
    }
    if !settings.text.trim().is_empty() {
        html.element("p", "said", settings.text.trim());
    }
    let mut key = vec![("σ₀".to_owned(), adjustment.sigma0.map_or("–".to_owned(), |s| fixed(s, 3)))];
    if let Some(test) = &adjustment.global_test {
        let interval = format!("{} [{}, {}]", words.chi_squared(), fixed(test.lower, 0), fixed(test.upper, 0));
        key.push((interval, fixed(test.statistic, 1)));
    }
    if let Some(estimated) = super::statistics::estimated(context) {
        key.push((words.estimated_from_residuals().to_owned(), estimated));
    }
    key.push((words.redundancy().to_owned(), count(adjustment.redundancy)));
    if let Some(n) = adjustment.precision.as_ref().and_then(|p| p.relative) {
        key.push((words.relative_accuracy().to_owned(), format!("1 : {}", count(three_digits(n)))));
    }
    html.open("div", "key");
    for (name, value) in key {
        html.open("div", "").element("span", "", &name).element("b", "", &value).close("div");
    }
    html.close("div");
    if let Some(picture) = network::picture(context) {
        html.open("figure", "picture").raw(&picture.svg);
        html.open("figcaption", "").raw(&escaped(&picture.sentence)).close("figcaption").close("figure");
    }
    html.close("header");
}
