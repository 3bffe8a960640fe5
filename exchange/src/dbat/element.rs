//! A small XML document as a tree: names, attributes, text.

use crate::reason::ExchangeReason;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use sightline::error::{Error, Place, Result, shortened};

/// Deepest nesting that is followed.
const DEPTH_LIMIT: usize = 64;

/// An element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Element {
    pub name: String,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    /// The text directly inside, without the blanks around it.
    pub text: String,
}

impl Element {
    /// The first child of a name.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name)
    }

    /// All children of a name.
    pub fn children<'a>(&'a self, name: &'a str) -> impl DoubleEndedIterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// An attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }
}

/// The document's element.
pub fn parse(text: &str) -> Result<Element> {
    let mut reader = Reader::from_str(text);
    let line =
        |position: u64| text.as_bytes().iter().take(position as usize).filter(|byte| **byte == b'\n').count() + 1;
    let mut open = vec![Element::default()];
    loop {
        let event = reader.read_event();
        let wrong = |reason| Error::Invalid {
            reason,
            at: Place::line(line(reader.error_position().max(reader.buffer_position()))),
        };
        let damaged = |message: String| wrong(ExchangeReason::DamagedXml { message: shortened(&message) }.into());
        match event.map_err(|error| damaged(error.to_string()))? {
            Event::Start(tag) if open.len() < DEPTH_LIMIT => open.push(element(&tag).map_err(damaged)?),
            Event::Start(_) => return Err(wrong(ExchangeReason::XmlTooDeep { limit: DEPTH_LIMIT }.into())),
            Event::Empty(tag) => {
                let element = element(&tag).map_err(damaged)?;
                open.last_mut().expect("the root stays open").children.push(element);
            }
            Event::End(_) => {
                let mut done = open.pop().expect("the reader checks that ends match");
                done.text = done.text.trim().to_owned();
                open.last_mut().expect("the root stays open").children.push(done);
            }
            Event::Text(text) => add(&mut open, &text),
            Event::CData(data) => add(&mut open, &data),
            Event::GeneralRef(reference) => {
                match reference.resolve_char_ref().map_err(|error| damaged(error.to_string()))? {
                    Some(character) => add(&mut open, character.encode_utf8(&mut [0; 4])),
                    None => {
                        let text = quick_xml::escape::resolve_predefined_entity(&reference);
                        add(
                            &mut open,
                            text.ok_or_else(|| {
                                wrong(ExchangeReason::XmlEntity { name: shortened(&reference) }.into())
                            })?,
                        );
                    }
                }
            }
            Event::Eof => break,
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::DocType(_) => {}
        }
    }
    let missing = |reason| Error::Invalid { reason, at: Place::default() };
    if open.len() != 1 {
        return Err(missing(ExchangeReason::XmlOpen { name: shortened(&open[open.len() - 1].name) }.into()));
    }
    open.pop().and_then(|mut root| root.children.pop()).ok_or_else(|| missing(ExchangeReason::XmlEmpty.into()))
}

fn add(open: &mut [Element], text: &str) {
    if let Some(element) = open.last_mut() {
        element.text.push_str(text);
    }
}

fn element(tag: &BytesStart<'_>) -> std::result::Result<Element, String> {
    let mut attributes = Vec::new();
    for attribute in tag.attributes() {
        let attribute = attribute.map_err(|error| error.to_string())?;
        let value = quick_xml::escape::unescape(&attribute.value).map_err(|error| error.to_string())?.into_owned();
        attributes.push((attribute.key.as_ref().to_owned(), value));
    }
    Ok(Element { name: tag.name().as_ref().to_owned(), attributes, ..Element::default() })
}
