//! The engine in a worker of the page: it reads a task's files, does the task and answers. Nothing else of the engine's
//! heavy parts is in the page's own module.

mod codecs;
mod decoded;
mod foreign;
mod inside;
mod judged;
mod scope;
mod tasks;

/// Does every task of the page.
pub struct Engine;

fn main() {
    scope::serve_requests();
}
