//! Targets to print: what is wanted, the sheet as it will be, the ruler of the print and which diameter suits.

use leptos::prelude::*;
use sightline::ring_code::{Design, Family};
use sightline_report::sheets::{AdviceOptions, Field as Plate, Ground, LEAST_PX, Paper, Pattern, SheetOptions, advice};

use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use crate::browser::event;
use crate::format;
use crate::i18n::printing as words;
use crate::i18n::{Text, errors};
use crate::store::Desk;
use crate::store::printing::Saved;
use crate::view::components::title::TitleBar;

/// Distances of the table, mm.
const DISTANCES: [f64; 9] = [500.0, 1000.0, 1500.0, 2000.0, 3000.0, 4000.0, 6000.0, 8000.0, 10_000.0];

#[component]
pub fn Printing() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let printing = desk.printing;
    Effect::new(move || desk.draw_sheets(desk.sheet_options(), printing.sheet.get()));
    let sheets = Memo::new(move |_| {
        printing.drawn.with(|d| d.as_ref().and_then(|d| d.as_ref().ok()).map_or(0, |d| d.titles.len()))
    });
    let sentence = move || {
        printing.drawn.with(|drawn| match drawn {
            Some(Ok(d)) => words::sheets_sentence(
                format::count(d.codes),
                format::count(d.dots),
                format::count(d.bars),
                format::count(d.titles.len()),
            ),
            _ => words::nothing_yet().to_owned(),
        })
    };
    let none = move || sheets.get() == 0;
    view! {
        <TitleBar title=words::targets_to_print sentence=Signal::derive(sentence)>
            <button class="button" data-action="lists" disabled=none on:click=move |_| desk.save_sheets(Saved::Lists)>{words::save_lists}</button>
            <button class="button" data-action="svg" disabled=none on:click=move |_| desk.save_sheets(Saved::Svg)>{words::save_svg}</button>
            <button class="button primary" data-action="pdf" disabled=none on:click=move |_| desk.save_sheets(Saved::Pdf)>
                <Glyph icon=Icon::Save/> {move || words::save_pdf(format::count(sheets.get()))}
            </button>
        </TitleBar>
        <main class="printing">
            <aside class="scroll" aria-label=words::targets_to_print><Wanted/></aside>
            <section class="sheet-view" aria-label=words::preview><Sheet/></section>
            <aside class="scroll" aria-label=words::which_diameter><Ruler/><Diameters/><Sketches/></aside>
        </main>
    }
}

/// A number of the options.
#[component]
fn Number(
    label: Text,
    name: &'static str,
    #[prop(default = "")] unit: &'static str,
    read: fn(&SheetOptions) -> f64,
    write: fn(&mut SheetOptions, f64),
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let value = Signal::derive(move || desk.printing.options.with(|o| format::editable(read(o))));
    view! {
        <label class="field">
            <span>{label}{(!unit.is_empty()).then(|| view! { " " <u>{unit}</u> })}</span>
            <Field value commit=move |typed: String| {
                if let Some(value) = format::parse(&typed).filter(|v| v.is_finite()) {
                    desk.choose_sheets(|o| write(o, value));
                }
            } attr:name=name attr:inputmode="decimal"/>
        </label>
    }
}

#[component]
fn Tick(
    label: Text,
    name: &'static str,
    read: fn(&SheetOptions) -> bool,
    write: fn(&mut SheetOptions, bool),
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <label class="tick">
            <input type="checkbox" name=name prop:checked=move || desk.printing.options.with(read)
                on:change=move |e| desk.choose_sheets(|o| write(o, event::checked(&e)))/>
            <span>{label}</span>
        </label>
    }
}

/// A choice among few values.
#[component]
fn Choice<T: Copy + PartialEq + Send + Sync + 'static>(
    label: Text,
    name: &'static str,
    values: Vec<(T, String)>,
    read: fn(&SheetOptions) -> T,
    write: fn(&mut SheetOptions, T),
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = StoredValue::new(values.iter().map(|(value, _)| *value).collect::<Vec<_>>());
    view! {
        <label class="field">
            <span>{label}</span>
            <select name=name on:change=move |e| {
                let place = event::value(&e).parse::<usize>().ok();
                if let Some(value) = place.and_then(|k| all.with_value(|all| all.get(k).copied())) {
                    desk.choose_sheets(|o| write(o, value));
                }
            }>
                {values.into_iter().enumerate().map(|(k, (value, words))| view! {
                    <option value=k selected=move || desk.printing.options.with(read) == value>{words}</option>
                }).collect_view()}
            </select>
        </label>
    }
}

fn family_words(family: Family) -> String {
    match family.design() {
        Design::Schneider => words::schneider(family.bits()),
        Design::Metashape => words::metashape(family.bits()),
    }
}

fn whole(value: f64, most: f64) -> u32 {
    value.clamp(0.0, most) as u32
}

/// Contents of the sheets.
#[component]
fn Wanted() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let options = desk.printing.options;
    let numbers = Signal::derive(move || options.with(|o| o.numbers.clone()));
    let title = Signal::derive(move || options.with(|o| o.title.clone()));
    let plated = move || options.with(|o| o.field.is_some());
    let barred = move || options.with(|o| o.bars > 0);
    let dotted = move || options.with(|o| o.dots > 0);
    // The language is read here, so that the lists are made anew with it.
    let lists = move || {
        view! {
            <Choice label=words::family name="family" values=Family::ALL.map(|f| (f, family_words(f))).to_vec()
                read=|o| o.family write=|o, v| o.family = v/>
        }
    };
    let grounds = move || {
        view! {
            <Choice label=words::ground name="ground"
                values=vec![(Ground::Paper, words::ground_paper().to_owned()), (Ground::Retro, words::ground_retro().to_owned())]
                read=|o| o.ground write=|o, v| o.ground = v/>
        }
    };
    let papers = vec![(Paper::A4, "A4".to_owned()), (Paper::A3, "A3".to_owned()), (Paper::Letter, "Letter".to_owned())];
    view! {
        <h2 class="section-head"><span>{words::coded_targets}</span></h2>
        <div class="fields">
            {lists}
            <Number label=words::how_many name="codes" read=|o| f64::from(o.codes) write=|o, v| {
                o.codes = whole(v, 1e6);
                o.numbers.clear();
            }/>
            <label class="field">
                <span>{words::numbers}<small>{words::numbers_hint}</small></span>
                <Field value=numbers commit=move |typed: String| desk.choose_sheets(|o| o.numbers = typed) attr:name="numbers"/>
            </label>
            <Number label=words::dot_diameter name="diameter" unit="mm" read=|o| o.diameter write=|o, v| o.diameter = v/>
            {grounds}
        </div>
        <Distances/>
        <h2 class="section-head"><span>{words::also_on_sheets}</span></h2>
        <div class="fields">
            <Number label=words::plain_dots name="dots" read=|o| f64::from(o.dots) write=|o, v| o.dots = whole(v, 1e6)/>
            <Show when=dotted>
                <Tick label=words::jittered name="jittered" read=|o| o.pattern == Pattern::Jittered
                    write=|o, on| o.pattern = if on { Pattern::Jittered } else { Pattern::Regular }/>
            </Show>
            <Number label=words::bar_pairs name="bars" read=|o| f64::from(o.bars) write=|o, v| o.bars = whole(v, 1e4)/>
            <Show when=barred>
                <Number label=words::bar_length name="bar-length" unit="mm" read=|o| o.bar_length write=|o, v| o.bar_length = v/>
            </Show>
            <Tick label=words::calibration_field name="field" read=|o| o.field.is_some()
                write=|o, on| o.field = on.then(Plate::default)/>
            <Show when=plated>
                <div class="field">
                    <span>{words::field_sheets}</span>
                    <span class="pair">
                        <Plates name="columns" read=|p| p.columns write=|p, n| p.columns = n/>
                        "×"
                        <Plates name="rows" read=|p| p.rows write=|p, n| p.rows = n/>
                    </span>
                </div>
            </Show>
            <Tick label=words::cut_marks name="cut-marks" read=|o| o.cut_marks write=|o, on| o.cut_marks = on/>
            <Tick label=words::small_print name="labels" read=|o| o.labels write=|o, on| o.labels = on/>
        </div>
        <h2 class="section-head"><span>{words::paper}</span></h2>
        <div class="fields">
            <Choice label=words::paper name="paper" values=papers read=|o| o.paper write=|o, v| o.paper = v/>
            <label class="field">
                <span>{words::sheet_title}</span>
                <Field value=title commit=move |typed: String| desk.choose_sheets(|o| o.title = typed) attr:name="title"/>
            </label>
        </div>
    }
}

/// Sheets of a calibration field along one side.
#[component]
fn Plates(name: &'static str, read: fn(&Plate) -> u32, write: fn(&mut Plate, u32)) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let value = Signal::derive(move || {
        desk.printing.options.with(|o| o.field.as_ref().map_or(String::new(), |plate| read(plate).to_string()))
    });
    view! {
        <Field value commit=move |typed: String| {
            if let Some(count) = format::parse(&typed).filter(|n| *n >= 1.0) {
                desk.choose_sheets(|o| if let Some(plate) = &mut o.field { write(plate, whole(count, 30.0)) });
            }
        } attr:name=name attr:aria-label=words::field_sheets attr:inputmode="numeric"/>
    }
}

/// How far the codes of the family, and those on the sheets, are from each other.
#[component]
fn Distances() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let told = move || {
        desk.printing.drawn.with(|drawn| {
            let drawn = drawn.as_ref()?.as_ref().ok()?;
            let all = drawn.counts.last().map_or(0, |count| count.count);
            let rows = drawn.counts.iter().filter(|c| c.distance > 2).map(|c| {
                view! { <li>{words::family_at_distance(format::count(c.count), c.distance)}</li> }
            });
            let rows = rows.collect_view();
            let printed = drawn.least_distance.map(|d| {
                view! { <p class="note">{words::printed_distance(d, d.saturating_sub(1))}</p> }
            });
            Some(view! {
                <div class="note spread"><span>{words::family_has(format::count(all))}</span><ul>{rows}</ul></div>
                {printed}
            })
        })
    };
    view! { <div class="distances">{told}</div> }
}

/// The sheet that is shown.
#[component]
fn Sheet() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let printing = desk.printing;
    let all = Memo::new(move |_| {
        printing.drawn.with(|d| d.as_ref().and_then(|d| d.as_ref().ok()).map_or(0, |d| d.titles.len()))
    });
    let svg = Memo::new(move |_| {
        printing.drawn.with(|d| d.as_ref().and_then(|d| d.as_ref().ok()).map_or(String::new(), |d| d.svg.clone()))
    });
    let title = move || {
        let sheet = printing.sheet.get();
        printing.drawn.with(|d| {
            d.as_ref().and_then(|d| d.as_ref().ok()).and_then(|d| d.titles.get(sheet).cloned()).unwrap_or_default()
        })
    };
    let fault = move || printing.drawn.with(|d| d.as_ref().and_then(|d| d.as_ref().err()).map(errors::sentence));
    view! {
        <div class="sheet-bar">
            <b>{move || (all.get() > 0).then(|| words::sheet_of(format::count(printing.sheet.get() + 1), format::count(all.get())))}</b>
            <span class="aside">{title}</span>
            <button class="icon-button back" aria-label=words::previous_sheet disabled=move || printing.sheet.get() == 0
                on:click=move |_| printing.sheet.update(|k| *k = k.saturating_sub(1))>
                <Glyph icon=Icon::Arrow/>
            </button>
            <button class="icon-button" aria-label=words::next_sheet disabled=move || { printing.sheet.get() + 1 >= all.get() }
                on:click=move |_| printing.sheet.update(|k| *k += 1)>
                <Glyph icon=Icon::Arrow/>
            </button>
        </div>
        {move || fault().map(|sentence| view! { <p class="note bad" role="alert"><Glyph icon=Icon::Warning/> " " {sentence}</p> })}
        <div class="sheet-shown" class:empty=move || svg.with(String::is_empty) inner_html=move || svg.get()></div>
    }
}

/// All sheets small, to go to one of them.
#[component]
fn Sketches() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let printing = desk.printing;
    // Another sheet drawn large leaves these as they are, and the focus where it is.
    let all = Memo::new(move |_| {
        printing.drawn.with(|drawn| {
            let drawn = drawn.as_ref()?.as_ref().ok()?;
            Some((drawn.sketches.clone(), drawn.titles.clone()))
        })
    });
    let rows = move || {
        let (sketches, titles) = all.get()?;
        let count = titles.len();
        let rows = sketches.into_iter().zip(titles).enumerate().map(|(k, (sketch, title))| {
            let shown = move || printing.sheet.get() == k;
            view! {
                <li>
                    <button class="sketch" class:chosen=shown aria-current=move || shown().then_some("true") data-sketch=k
                        on:click=move |_| printing.sheet.set(k)>
                        <span class="paper" aria-hidden="true" inner_html=sketch></span>
                        <span><b>{k + 1}</b>" "{title}</span>
                    </button>
                </li>
            }
        });
        Some(view! {
            <h2 class="section-head"><span>{words::sheets}</span><span class="aside">{format::count(count)}</span></h2>
            <ul class="sketches">{rows.collect_view()}</ul>
        })
    };
    view! { <div>{rows}</div> }
}

/// Measured lengths of the rulers, and the derived scales.
#[component]
fn Ruler() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let options = desk.printing.options;
    let shown = move |read: fn(&SheetOptions) -> Option<f64>| {
        Signal::derive(move || options.with(|o| read(o).map_or(String::new(), format::editable)))
    };
    let commit = move |write: fn(&mut SheetOptions, Option<f64>)| {
        move |typed: String| {
            if typed.trim().is_empty() {
                desk.choose_sheets(|o| write(o, None));
            } else if let Some(value) = format::parse(&typed).filter(|v| v.is_finite()) {
                desk.choose_sheets(|o| write(o, Some(value)));
            }
        }
    };
    let told = move || {
        let measured = options.with(|o| o.measured.or(o.measured_down).is_some());
        desk.printing.drawn.with(|drawn| match drawn {
            Some(Ok(d)) if measured => words::print_scale(
                format::fixed(d.scale[0], 4),
                format::fixed(d.scale[1], 4),
                format::fixed(d.scale_sigma, 4),
                format::fixed(d.diameter, 3),
            ),
            _ => words::not_measured().to_owned(),
        })
    };
    view! {
        <h2 class="section-head"><span>{words::ruler_of_print}</span><span class="aside">{words::one_is_enough}</span></h2>
        <div class="fields">
            <label class="field"><span>{words::ruler_across}" "<u>"mm"</u></span>
                <Field value=shown(|o| o.measured) commit=commit(|o, v| o.measured = v)
                    attr:name="measured" attr:inputmode="decimal" attr:placeholder="100"/>
            </label>
            <label class="field"><span>{words::ruler_down}" "<u>"mm"</u></span>
                <Field value=shown(|o| o.measured_down) commit=commit(|o, v| o.measured_down = v)
                    attr:name="measured-down" attr:inputmode="decimal" attr:placeholder=words::as_across/>
            </label>
            <Number label=words::reading_sigma name="measured-sigma" unit="mm" read=|o| o.measured_sigma write=|o, v| o.measured_sigma = v/>
        </div>
        <p class="note told">{told}</p>
    }
}

/// Which diameter for which distance, for the project's camera.
#[component]
fn Diameters() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let rows = move || {
        let seeing = desk.seeing();
        let options = AdviceOptions {
            c_px: seeing.c_px,
            distances: DISTANCES.to_vec(),
            angles: vec![0.0, std::f64::consts::FRAC_PI_3],
            diameter: desk.printing.options.with(|o| o.diameter),
        };
        let rows = advice(&options).unwrap_or_default().into_iter().map(|row| {
            let [straight, slant] = [row.pixels[0], row.pixels[1]];
            let verdict = if straight < LEAST_PX {
                Some((Icon::Cross, words::too_small()))
            } else if slant < LEAST_PX {
                Some((Icon::Warning, words::just_so()))
            } else {
                None
            };
            let class = if straight < LEAST_PX { "bad" } else if slant < LEAST_PX { "warn" } else { "" };
            view! {
                <tr>
                    <td>{format::fixed(row.distance / 1000.0, 1)}</td>
                    <td>{format::fixed(row.pixel, 2)}</td>
                    <td>{format::fixed(row.least[0], 1)}</td>
                    <td>{format::fixed(row.least[1], 1)}</td>
                    <td><b>{format::fixed(row.best[0], 1)}</b></td>
                    <td class=class>{format::fixed(straight, 1)}</td>
                    <td class=class>{format::fixed(slant, 1)}</td>
                    <td class=class>{verdict.map(|(icon, words)| view! { <span title=words><Glyph icon size=13/><span class="visually-hidden">{words}</span></span> })}</td>
                </tr>
            }
        });
        rows.collect_view()
    };
    let camera = move || {
        let seeing = desk.seeing();
        if seeing.assumed {
            words::camera_assumed().to_owned()
        } else {
            words::camera_words(format::fixed(seeing.c_px, 0), seeing.size[0], seeing.size[1])
        }
    };
    view! {
        <h2 class="section-head"><span>{words::which_diameter}</span></h2>
        <p class="note">{camera}</p>
        <div class="scroll-x" tabindex="0" role="region" aria-label=words::which_diameter>
            <table class="table diameters">
                <thead>
                    <tr>
                        <th>{words::col_distance}" "<u>"m"</u></th>
                        <th>{words::col_pixel}" "<u>"mm"</u></th>
                        <th colspan="2">{words::col_least}" "<u>"mm"</u></th>
                        <th>{words::col_best}" "<u>"mm"</u></th>
                        <th colspan="3">{words::col_dot}" "<u>"px"</u></th>
                    </tr>
                    <tr>
                        <td></td><td></td>
                        <th>{words::straight_on}</th><th>{words::at_slant}</th>
                        <th>{words::straight_on}</th>
                        <th>{words::straight_on}</th><th>{words::at_slant}</th><td></td>
                    </tr>
                </thead>
                <tbody>{rows}</tbody>
            </table>
        </div>
        <p class="note">{words::advice_words}</p>
        <p class="note">{words::print_hint}</p>
    }
}
