//! The sections of the report in their order, numbered as they come.

mod all_observations;
mod cameras;
mod control;
mod cover;
mod features;
mod gross_errors;
mod left_out;
mod lengths;
mod network;
mod observations;
mod origin;
mod patterns;
mod photos;
mod points;
mod residuals;
mod settings;
mod statistics;
mod summary;
mod uncertainty;

use super::context::Context;
use super::html::{Html, escaped};
use super::plots::{self, Group, Plot};
use sightline::project::Section;

/// The whole report; empty sections are left out.
pub fn all(context: &Context) -> String {
    let mut html = Html::default();
    html.raw(&format!("<article class=\"report\" lang=\"{}\">\n", context.language_tag()));
    cover::write(context, &mut html);
    let plots = plots::all(context);
    let mut number = 0;
    for section in Section::ALL.into_iter().filter(|section| context.settings().has(*section)) {
        let mut content = Html::default();
        write(section, context, &mut content);
        if let Some(group) = group(section) {
            figures(
                &mut content,
                plots.iter().filter(|plot| plot.group == group && plot.name != plots::network::PICTURE),
            );
        }
        let content = content.finish();
        if content.is_empty() {
            continue;
        }
        number += 1;
        html.raw(&format!("<section data-section=\"{}\">\n", name(section)));
        html.element("h2", "", &format!("{number}  {}", title(section, context)));
        html.raw(&content).close("section");
    }
    html.close("article");
    html.finish()
}

/// The plots that a section shows.
fn group(section: Section) -> Option<Group> {
    match section {
        Section::Cameras => Some(Group::Cameras),
        Section::Network => Some(Group::Network),
        Section::Points => Some(Group::Points),
        Section::Statistics => Some(Group::Statistics),
        Section::Residuals => Some(Group::Residuals),
        Section::Features => Some(Group::Features),
        _ => None,
    }
}

/// Plots beside each other, those of single photos smaller.
pub(super) fn figures<'a>(html: &mut Html, plots: impl Iterator<Item = &'a Plot> + Clone) {
    for small in [false, true] {
        let mut chosen = plots.clone().filter(|plot| plot.small == small).peekable();
        if chosen.peek().is_none() {
            continue;
        }
        html.open("div", if small { "figures small" } else { "figures" });
        for plot in chosen {
            html.open("figure", "").open("figcaption", "").element("b", "", &plot.title);
            html.raw(&escaped(&plot.sentence)).close("figcaption").raw(&plot.svg).close("figure");
        }
        html.close("div");
    }
}

fn write(section: Section, context: &Context, html: &mut Html) {
    match section {
        Section::Summary => summary::write(context, html),
        Section::Uncertainty => uncertainty::write(context, html),
        Section::Observations => observations::write(context, html),
        Section::Cameras => cameras::write(context, html),
        Section::Network => network::write(context, html),
        Section::Photos => photos::write(context, html),
        Section::Points => points::write(context, html),
        Section::Control => control::write(context, html),
        Section::Lengths => lengths::write(context, html),
        Section::Statistics => statistics::write(context, html),
        Section::Residuals => residuals::write(context, html),
        Section::GrossErrors => gross_errors::write(context, html),
        Section::Features => features::write(context, html),
        Section::Settings => settings::write(context, html),
        Section::AllObservations => all_observations::write(context, html),
    }
}

/// Its word in the document.
fn name(section: Section) -> &'static str {
    match section {
        Section::Summary => "summary",
        Section::Uncertainty => "uncertainty",
        Section::Observations => "observations",
        Section::Cameras => "cameras",
        Section::Network => "network",
        Section::Photos => "photos",
        Section::Points => "points",
        Section::Control => "control",
        Section::Lengths => "lengths",
        Section::Statistics => "statistics",
        Section::Residuals => "residuals",
        Section::GrossErrors => "gross_errors",
        Section::Features => "features",
        Section::Settings => "settings",
        Section::AllObservations => "all_observations",
    }
}

fn title(section: Section, context: &Context) -> &'static str {
    let words = context.words;
    match section {
        Section::Summary => words.summary(),
        Section::Uncertainty => words.uncertainty(),
        Section::Observations => words.observations_and_unknowns(),
        Section::Cameras => words.cameras(),
        Section::Network => words.network(),
        Section::Photos => words.photos(),
        Section::Points => words.points(),
        Section::Control => words.control_check_scale(),
        Section::Lengths => words.lengths(),
        Section::Statistics => words.statistics(),
        Section::Residuals => words.residuals(),
        Section::GrossErrors => words.left_out(),
        Section::Features => words.features(),
        Section::Settings => words.settings(),
        Section::AllObservations => words.all_observations(),
    }
}
