//! Inputs of each experiment, with the paper's values as defaults.

use leptos::prelude::*;
use sightline::detection::Method;
use sightline_lab::experiments::ExperimentOptions;

use crate::browser::event;
use crate::format;
use crate::i18n::experiments as words;
use crate::i18n::{Text, errors, text};
use crate::store::Desk;

/// Reads and writes a number of the options.
#[derive(Clone, Copy)]
struct Field {
    label: Text,
    name: &'static str,
    read: fn(&ExperimentOptions) -> Option<f64>,
    write: fn(&mut ExperimentOptions, f64),
    default: f64,
}

const SEED: Field = Field {
    label: words::in_seed,
    name: "seed",
    read: |o| Some(o.seed as f64),
    write: |o, v| o.seed = v.clamp(0.0, 1e15) as u64,
    default: 1.0,
};
const IMAGE_SIGMA: Field = Field {
    label: words::in_image_sigma,
    name: "image-sigma",
    read: |o| o.image_sigma_um,
    write: |o, v| o.image_sigma_um = Some(v),
    default: 3.0,
};
const ROUNDS: Field = Field {
    label: words::in_rounds,
    name: "rounds",
    read: |o| o.rounds.map(|n| n as f64),
    write: |o, v| o.rounds = Some(v.clamp(0.0, 1e6) as usize),
    default: 800.0,
};
const PIXEL_NOISE: Field = Field {
    label: words::in_pixel_noise,
    name: "pixel-noise",
    read: |o| o.pixel_noise.map(|n| 100.0 * n),
    write: |o, v| o.pixel_noise = Some(v / 100.0),
    default: 1.0,
};

const fn control_sigma(default: f64) -> Field {
    Field {
        label: words::in_control_sigma,
        name: "control-sigma",
        read: |o| o.control_sigma_mm,
        write: |o, v| o.control_sigma_mm = Some(v),
        default,
    }
}

#[component]
pub fn Inputs(name: &'static str) -> impl IntoView {
    let fields: &[Field] = match name {
        "kang" => &[IMAGE_SIGMA, const { control_sigma(0.001) }, ROUNDS, SEED],
        "film" => &[IMAGE_SIGMA, SEED],
        "lee-calibration" | "sensor" => &[PIXEL_NOISE, SEED],
        "lee-structure" => &[IMAGE_SIGMA, const { control_sigma(0.01) }, SEED],
        _ => &[PIXEL_NOISE, const { control_sigma(0.3) }, SEED],
    };
    let own = match name {
        "kang" => view! { <KangNetwork/> }.into_any(),
        "lee-calibration" => view! { <Centres/><LeftOut/> }.into_any(),
        "lee-structure" => view! { <LeeNetwork/> }.into_any(),
        _ => ().into_any(),
    };
    view! {
        <div class="fields inputs">
            {own}
            {fields.iter().map(|field| view! { <Number experiment=name field=*field/> }).collect_view()}
            {(name == "kim").then(|| view! { <PapersInstrument/> })}
        </div>
    }
}

/// Kim's total station is specified with 2 mm + 2 ppm; the standard input is what its coordinates must have been better than.
#[component]
fn PapersInstrument() -> impl IntoView {
    const SIGMA_MM: f64 = 2.0;
    let desk = expect_context::<Desk>();
    let run = move |_| {
        desk.experiments.vary("kim", |options| options.control_sigma_mm = Some(SIGMA_MM));
        desk.run_experiment();
    };
    view! {
        <button class="button" data-action="papers-instrument" disabled=move || desk.tasks.job.with(Option::is_some) on:click=run>
            {move || words::papers_instrument(format::editable(SIGMA_MM))}
        </button>
    }
}

#[component]
fn Number(experiment: &'static str, field: Field) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let value = move || {
        let options = desk.experiments.options(experiment);
        format::editable((field.read)(&options).unwrap_or(field.default))
    };
    let take = move |typed: String| match format::parse(&typed) {
        Some(value) => desk.experiments.vary(experiment, |options| (field.write)(options, value)),
        None => {
            desk.warn(move || errors::refusal(&typed, text::not_a_number));
            // The field shows again what is chosen.
            desk.experiments.vary(experiment, |_| {});
        }
    };
    view! {
        <label class="field">
            <span>{field.label}</span>
            <input type="text" inputmode="decimal" name=field.name prop:value=value on:change=move |e| take(event::value(&e))/>
        </label>
    }
}

/// A choice among named values.
#[component]
fn Choice(
    label: Text,
    name: &'static str,
    #[prop(into)] choices: Signal<Vec<(String, String)>>,
    #[prop(into)] chosen: Signal<String>,
    on_choose: Callback<String>,
) -> impl IntoView {
    view! {
        <label class="field">
            <span>{label}</span>
            <select name=name on:change=move |e| on_choose.run(event::value(&e))>
                {move || {
                    let now = chosen.get();
                    choices.get().into_iter().map(|(value, words)| {
                        let selected = value == now;
                        view! { <option value=value selected=selected>{words}</option> }
                    }).collect_view()
                }}
            </select>
        </label>
    }
}

/// The network that Monte Carlo runs on and that is opened: `1.4-5A`, or a letter for mixed distances.
#[component]
fn KangNetwork() -> impl IntoView {
    let desk = expect_context::<Desk>();
    const DISTANCES: [&str; 5] = ["1.4", "1.8", "2.5", "4.0", "7.0"];
    const MIXED: [&str; 16] = ["H", "I", "J", "K", "L", "M", "N", "O", "H'", "I'", "J'", "K'", "L'", "M'", "N'", "O'"];
    let network = Memo::new(move |_| desk.experiments.options("kang").network.unwrap_or_else(|| "1.4-5A".to_owned()));
    let parts = Memo::new(move |_| {
        network.with(|name| {
            let (distance, rest) = name.split_once('-')?;
            let photos = rest.get(..1)?;
            Some([distance.to_owned(), photos.to_owned(), rest.get(1..)?.to_owned()])
        })
    });
    let set = move |name: String| desk.experiments.vary("kang", |options| options.network = Some(name));
    let part = move |k: usize| Signal::derive(move || parts.get().map(|p| p[k].clone()).unwrap_or_default());
    let with = move |k: usize, value: String| {
        let mut all = parts.get_untracked().unwrap_or_else(|| ["1.4", "5", "A"].map(str::to_owned));
        all[k] = value;
        set(format!("{}-{}{}", all[0], all[1], all[2]));
    };
    let distance = Signal::derive(move || parts.get().map_or("mixed".to_owned(), |p| p[0].clone()));
    let distances = Signal::derive(move || {
        let plain = DISTANCES.iter().map(|d| ((*d).to_owned(), format!("{d} m")));
        plain.chain([("mixed".to_owned(), words::in_mixed().to_owned())]).collect::<Vec<_>>()
    });
    let on_distance =
        Callback::new(move |value: String| if value == "mixed" { set("H".into()) } else { with(0, value) });
    let counts = Signal::derive(|| (2..=5).map(|n| (n.to_string(), n.to_string())).collect::<Vec<_>>());
    let kinds = Signal::derive(move || {
        let many = parts.get().is_some_and(|p| p[1] == "4" || p[1] == "5");
        let overlaps = if many { ["80 + 70 %", "80 + 60 %", "70 + 60 %"] } else { ["80 %", "70 %", "60 %"] };
        let kind = |(kind, overlap): (&str, &str)| (kind.to_owned(), format!("{kind}: {overlap}"));
        ["A", "B", "C"].into_iter().zip(overlaps).map(kind).collect::<Vec<_>>()
    });
    let mixed = Signal::derive(|| MIXED.iter().map(|m| ((*m).to_owned(), (*m).to_owned())).collect::<Vec<_>>());
    view! {
        <Choice label=words::in_distance name="distance" choices=distances chosen=distance on_choose=on_distance/>
        <Show
            when=move || parts.with(Option::is_some)
            fallback=move || view! {
                <Choice label=words::in_combination name="combination" choices=mixed chosen=network on_choose=Callback::new(set)/>
            }
        >
            <Choice label=words::in_photos name="photos" choices=counts chosen=part(1) on_choose=Callback::new(move |v| with(1, v))/>
            <Choice label=words::in_overlap name="overlap" choices=kinds chosen=part(2) on_choose=Callback::new(move |v| with(2, v))/>
        </Show>
    }
}

/// Network and datum of the project to open.
#[component]
fn LeeNetwork() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let parts = Memo::new(move |_| {
        let name = desk.experiments.options("lee-structure").network.unwrap_or_else(|| "I-free".to_owned());
        let (network, datum) = name.split_once('-').unwrap_or(("I", "free"));
        [network.to_owned(), datum.to_owned()]
    });
    let with = move |k: usize, value: String| {
        let mut all = parts.get_untracked();
        all[k] = value;
        desk.experiments.vary("lee-structure", |options| options.network = Some(all.join("-")));
    };
    let networks = Signal::derive(|| ["I", "II", "III"].map(|n| (n.to_owned(), n.to_owned())).to_vec());
    let datums = Signal::derive(|| {
        vec![("control".to_owned(), words::control().to_owned()), ("free".to_owned(), words::free().to_owned())]
    });
    let part = move |k: usize| Signal::derive(move || parts.with(|p| p[k].clone()));
    view! {
        <Choice label=words::in_network name="network" choices=networks chosen=part(0) on_choose=Callback::new(move |v| with(0, v))/>
        <Choice label=words::in_datum name="datum" choices=datums chosen=part(1) on_choose=Callback::new(move |v| with(1, v))/>
    }
}

const METHODS: [(Method, &str, Text); 4] = [
    (Method::Intensity, "intensity", text::method_intensity),
    (Method::Gradient, "gradient", text::method_gradient),
    (Method::Ellipse, "ellipse", text::method_ellipse),
    (Method::LeastSquares, "least_squares", text::method_least_squares),
];

/// Which centres are adjusted.
#[component]
fn Centres() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let chosen = Signal::derive(move || {
        let method = desk.experiments.options("lee-calibration").method.unwrap_or(Method::Intensity);
        METHODS.iter().find(|(m, ..)| *m == method).map_or("", |(_, name, _)| *name).to_owned()
    });
    let choices = Signal::derive(|| METHODS.map(|(_, name, words)| (name.to_owned(), words().to_owned())).to_vec());
    let choose = Callback::new(move |value: String| {
        let method = METHODS.iter().find(|(_, name, _)| *name == value).map(|(m, ..)| *m);
        desk.experiments.vary("lee-calibration", |options| options.method = method);
    });
    view! { <Choice label=words::in_method name="method" choices=choices chosen=chosen on_choose=choose/> }
}

/// Photos left out of the second run.
#[component]
fn LeftOut() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let value = move || {
        let options = desk.experiments.options("lee-calibration");
        options.left_out.map_or("2 3 7 11".to_owned(), |photos| photos.join(" "))
    };
    let take = move |typed: String| {
        let photos = typed.split([' ', ',', ';']).filter(|p| !p.is_empty()).map(str::to_owned).collect::<Vec<_>>();
        desk.experiments.vary("lee-calibration", |options| options.left_out = Some(photos));
    };
    view! {
        <label class="field">
            <span>{words::in_left_out}<small class="hint">{words::left_out_hint}</small></span>
            <input type="text" name="left-out" prop:value=value on:change=move |e| take(event::value(&e))/>
        </label>
    }
}
