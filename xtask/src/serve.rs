//! A server of one folder on the loopback address, for developing and testing the page.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::sync::OnceLock;

use crate::Outcome;
use crate::build::{Products, Profile};
use crate::page::CODECS;

/// `serve [--port N]`.
pub fn command(arguments: &[String]) -> Outcome {
    let port = match arguments {
        [] => None,
        [flag, port] if flag == "--port" => {
            Some(port.parse::<u16>().map_err(|_| format!("{port} is no port (0 to 65535)"))?)
        }
        _ => return Err("serve [--port N]".into()),
    };
    let products = Products::of(Profile::Fast)?;
    products.build_page()?;
    let listener = match port {
        Some(port) => listen(port)?,
        None => (8080..8100).find_map(|port| listen(port).ok()).map_or_else(|| listen(0), Ok)?,
    };
    println!("{} (Ctrl-C stops)", address(&listener)?);
    let decoders = OnceLock::new();
    std::thread::scope(|threads| {
        threads.spawn(|| {
            if let Err(fault) = products.build_decoders() {
                eprintln!("HEIC and RAW photos are not decoded: {fault}");
            }
            decoders.set(()).ok();
        });
        answer(listener, &products.dist, Some(&decoders));
    });
    Ok(())
}

/// Serves a folder in the background until the process ends. Returns the address.
pub fn background(folder: PathBuf) -> Outcome<String> {
    let listener = listen(0)?;
    let address = address(&listener)?;
    std::thread::spawn(move || answer(listener, &folder, None));
    Ok(address)
}

fn listen(port: u16) -> Outcome<TcpListener> {
    TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|error| format!("port {port}: {error}"))
}

fn address(listener: &TcpListener) -> Outcome<String> {
    listener.local_addr().map(|address| format!("http://{address}/")).map_err(|error| error.to_string())
}

/// Answers requests until the process ends. Each connection has its own thread and one request: browsers open connections in advance
/// and leave them idle, and an idle one must not block another. Requests for the decoders wait until `decoders` is set.
fn answer(listener: TcpListener, folder: &Path, decoders: Option<&OnceLock<()>>) {
    std::thread::scope(|threads| {
        for stream in listener.incoming().flatten() {
            // Fails if the browser has closed the connection: then no answer is needed.
            threads.spawn(move || respond(stream, folder, decoders).ok());
        }
    });
}

/// Maximum length of a request's header in bytes.
const LONGEST_HEAD: u64 = 64 << 10;

/// Reads the header of a request and sends the requested file. A GET request has no body.
fn respond(stream: TcpStream, folder: &Path, decoders: Option<&OnceLock<()>>) -> std::io::Result<()> {
    let mut head = Vec::new();
    let mut reader = BufReader::new(stream.try_clone()?.take(LONGEST_HEAD));
    while !matches!(head.as_slice(), [.., b'\n', b'\r', b'\n'] | [.., b'\n', b'\n']) {
        if reader.read_until(b'\n', &mut head)? == 0 {
            return Ok(());
        }
    }
    let head = String::from_utf8_lossy(&head);
    let mut words = head.split_ascii_whitespace();
    let asked = (words.next() == Some("GET")).then(|| words.next()).flatten();
    let mut stream = stream;
    if let (Some(decoders), Some(address)) = (decoders, asked)
        && address.rsplit('/').next().unwrap_or_default().starts_with(CODECS)
    {
        decoders.wait();
    }
    match asked.and_then(|address| file(folder, address)) {
        Some((mut file, kind)) => {
            write_head(&mut stream, "200 OK", kind, file.metadata()?.len())?;
            std::io::copy(&mut file, &mut stream)?;
        }
        None => {
            let body = b"not found";
            write_head(&mut stream, "404 Not Found", "text/plain", body.len() as u64)?;
            stream.write_all(body)?;
        }
    }
    stream.flush()
}

fn write_head(stream: &mut TcpStream, status: &str, kind: &str, length: u64) -> std::io::Result<()> {
    let headers = "Cache-Control: no-cache\r\nX-Content-Type-Options: nosniff\r\nConnection: close";
    write!(stream, "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{headers}\r\n\r\n")
}

/// The file at an address and its MIME type; `None` if it does not exist or is outside the folder. A folder's address gives its
/// index.html.
fn file(folder: &Path, address: &str) -> Option<(File, &'static str)> {
    let path = address.split(['?', '#']).next().unwrap_or_default();
    let mut place = folder.to_path_buf();
    for part in decoded(path)?.split('/').filter(|part| !part.is_empty()) {
        // Plain names only: no "..", and on Windows no drive.
        let mut components = Path::new(part).components();
        match (components.next(), components.next()) {
            (Some(Component::Normal(name)), None) => place.push(name),
            _ => return None,
        }
    }
    if place.is_dir() {
        place.push("index.html");
    }
    let kind = match place.extension().and_then(|ending| ending.to_str()).unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" => "application/json",
        "webmanifest" => "application/manifest+json",
        "wasm" => "application/wasm",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        _ => "application/octet-stream",
    };
    Some((File::open(place).ok()?, kind))
}

/// The path with "%20" and the like decoded; `None` if the result is not UTF-8.
fn decoded(path: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = path.as_bytes();
    while let Some((&byte, tail)) = rest.split_first() {
        let hex = tail.get(..2).and_then(|hex| std::str::from_utf8(hex).ok());
        match hex.filter(|_| byte == b'%').and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(value) => {
                bytes.push(value);
                rest = &tail[2..];
            }
            None => {
                bytes.push(byte);
                rest = tail;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::process::root;

    /// Answer of the server to a request.
    fn ask(stream: &mut TcpStream, path: &str) -> std::io::Result<String> {
        write!(stream, "GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n")?;
        stream.set_read_timeout(Some(Duration::from_secs(10)))?;
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    fn connect(address: &str) -> TcpStream {
        TcpStream::connect(address.trim_start_matches("http://").trim_end_matches('/')).expect("a connection")
    }

    #[test]
    fn every_connection_of_a_burst_is_answered() {
        let address = background(root().join("xtask")).expect("a server");
        let mut open: Vec<_> = (0..64).map(|_| connect(&address)).collect();
        // The first half stays idle, as connections that a browser opens ahead.
        for stream in &mut open[32..] {
            let answer = ask(stream, "/Cargo.toml").expect("an answer");
            assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
            assert!(answer.contains("Cache-Control: no-cache"), "{answer}");
        }
    }

    #[test]
    fn only_files_of_the_folder_are_served() {
        let address = background(root().join("xtask")).expect("a server");
        let status = |path| ask(&mut connect(&address), path).expect("an answer")[9..12].to_owned();
        assert_eq!(status("/src/serve.rs?v=1"), "200");
        assert_eq!(status("/s%72c/serve.rs"), "200");
        assert_eq!(status("/%"), "404");
        for outside in ["/../Cargo.toml", "/%2e%2e/Cargo.toml", "/src/../../Cargo.toml", "//etc/passwd", "/src/none.rs"]
        {
            assert_ne!(status(outside), "200", "{outside}");
        }
    }
}
