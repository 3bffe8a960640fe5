//! A server of one folder on loopback, for the page while it is built and tested.

use std::fs;
use std::io::Cursor;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use tiny_http::{Header, Method, Request, Response, Server};

use crate::process::root;
use crate::{Outcome, build};

/// Requests answered at the same time: a browser opens up to six connections and keeps them.
const THREADS: usize = 8;

/// `serve [--port N]`.
pub fn command(arguments: &[String]) -> Outcome {
    let port = match arguments {
        [] => None,
        [flag, port] if flag == "--port" => {
            Some(port.parse::<u16>().map_err(|_| format!("{port} is no port (0 to 65535)"))?)
        }
        _ => return Err("serve [--port N]".into()),
    };
    build::dist()?;
    let server = match port {
        Some(port) => listen(port)?,
        None => (8080..8100).find_map(|port| listen(port).ok()).map_or_else(|| listen(0), Ok)?,
    };
    println!("{} (Ctrl-C stops)", address(&server));
    answer(server, &root().join("dist"));
    Ok(())
}

/// Serves a folder in the background until the process ends; its address.
pub fn background(folder: PathBuf) -> Outcome<String> {
    let server = listen(0)?;
    let address = address(&server);
    std::thread::spawn(move || answer(server, &folder));
    Ok(address)
}

fn listen(port: u16) -> Outcome<Arc<Server>> {
    Server::http(("127.0.0.1", port)).map(Arc::new).map_err(|error| format!("port {port}: {error}"))
}

fn address(server: &Server) -> String {
    format!("http://{}/", server.server_addr())
}

fn answer(server: Arc<Server>, folder: &Path) {
    std::thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(|| {
                while let Ok(request) = server.recv() {
                    // A browser that goes away in the middle of an answer is no concern of the server.
                    let _ = respond(request, folder);
                }
            });
        }
    });
}

fn respond(request: Request, folder: &Path) -> std::io::Result<()> {
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(Response::empty(405));
    }
    let found = file(folder, request.url()).and_then(|path| Some((fs::read(&path).ok()?, media_type(&path))));
    let Some((bytes, media_type)) = found else {
        return request.respond(Response::from_string("not found").with_status_code(404));
    };
    let length = bytes.len();
    let mut response = Response::new(200.into(), Vec::new(), Cursor::new(bytes), Some(length), None);
    for (name, value) in
        [("Content-Type", media_type), ("Cache-Control", "no-cache"), ("X-Content-Type-Options", "nosniff")]
    {
        response.add_header(Header::from_bytes(name, value).expect("ASCII"));
    }
    request.respond(response)
}

/// The file that a request's path names, inside the folder.
fn file(folder: &Path, url: &str) -> Option<PathBuf> {
    let path = decode(url.split(['?', '#']).next()?)?;
    let relative = Path::new(path.trim_start_matches('/'));
    if !relative.components().all(|part| matches!(part, Component::Normal(_))) {
        return None;
    }
    let path = folder.join(relative);
    let path = if path.is_dir() { path.join("index.html") } else { path };
    path.is_file().then_some(path)
}

/// Undoes percent encoding.
fn decode(path: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = path.bytes();
    while let Some(byte) = rest.next() {
        if byte == b'%' {
            let digits = [rest.next()?, rest.next()?];
            bytes.push(u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?);
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).ok()
}

fn media_type(path: &Path) -> &'static str {
    match path.extension().and_then(|name| name.to_str()).unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "json" | "map" => "application/json",
        "webmanifest" => "application/manifest+json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "webp" => "image/webp",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "txt" | "md" | "csv" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_the_folder_are_served() {
        let folder = root().join("xtask");
        assert_eq!(file(&folder, "/src/serve.rs?v=1"), Some(folder.join("src/serve.rs")));
        assert_eq!(file(&folder, "/s%72c/serve.rs"), Some(folder.join("src/serve.rs")));
        for outside in [
            "/../Cargo.toml",
            "/%2e%2e/Cargo.toml",
            "/src/../../Cargo.toml",
            "//etc/passwd",
            "/%",
            "/src/none.rs",
            "/src",
        ] {
            assert_eq!(file(&folder, outside), None, "{outside}");
        }
    }
}
