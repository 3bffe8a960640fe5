//! A server of one folder on loopback, for the page while it is built and tested.

use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};

use axum::Router;
use axum::http::{HeaderValue, header};
use tower_http::services::ServeDir;
use tower_http::set_header::SetResponseHeaderLayer;

use crate::process::root;
use crate::{Outcome, build};

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
    let listener = match port {
        Some(port) => listen(port)?,
        None => (8080..8100).find_map(|port| listen(port).ok()).map_or_else(|| listen(0), Ok)?,
    };
    println!("{} (Ctrl-C stops)", address(&listener)?);
    answer(listener, &root().join("dist"))
}

/// Serves a folder in the background until the process ends; its address.
pub fn background(folder: PathBuf) -> Outcome<String> {
    let listener = listen(0)?;
    let address = address(&listener)?;
    std::thread::spawn(move || answer(listener, &folder));
    Ok(address)
}

fn listen(port: u16) -> Outcome<TcpListener> {
    TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|error| format!("port {port}: {error}"))
}

fn address(listener: &TcpListener) -> Outcome<String> {
    listener.local_addr().map(|address| format!("http://{address}/")).map_err(|error| error.to_string())
}

/// Answers until the process ends. Connections wait for nobody: a browser keeps six of them open.
fn answer(listener: TcpListener, folder: &Path) -> Outcome {
    let always = |name, value| SetResponseHeaderLayer::overriding(name, HeaderValue::from_static(value));
    let site = Router::new()
        .fallback_service(ServeDir::new(folder))
        .layer(always(header::CACHE_CONTROL, "no-cache"))
        .layer(always(header::X_CONTENT_TYPE_OPTIONS, "nosniff"));
    let serve = async {
        listener.set_nonblocking(true)?;
        axum::serve(tokio::net::TcpListener::from_std(listener)?, site).await
    };
    let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build();
    runtime.and_then(|runtime| runtime.block_on(serve)).map_err(|error| format!("the server: {error}"))
}

#[cfg(test)]
mod tests {
    use std::io::{Read, Write};
    use std::net::TcpStream;
    use std::time::Duration;

    use super::*;

    /// What the server answers to a request on a new connection that stays open.
    fn ask(stream: &mut TcpStream, path: &str) -> std::io::Result<String> {
        write!(stream, "GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n")?;
        stream.set_read_timeout(Some(Duration::from_secs(10)))?;
        let mut bytes = [0; 4096];
        let read = stream.read(&mut bytes)?;
        Ok(String::from_utf8_lossy(&bytes[..read]).into_owned())
    }

    fn connect(address: &str) -> TcpStream {
        TcpStream::connect(address.trim_start_matches("http://").trim_end_matches('/')).expect("a connection")
    }

    #[test]
    fn every_connection_of_a_burst_is_answered() {
        let address = background(root().join("xtask")).expect("a server");
        let mut open: Vec<_> = (0..32).map(|_| connect(&address)).collect();
        for stream in &mut open {
            let answer = ask(stream, "/Cargo.toml").expect("an answer");
            assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
            assert!(answer.contains("cache-control: no-cache"), "{answer}");
        }
    }

    #[test]
    fn only_files_of_the_folder_are_served() {
        let address = background(root().join("xtask")).expect("a server");
        let status = |path| ask(&mut connect(&address), path).expect("an answer")[9..12].to_owned();
        assert_eq!(status("/src/serve.rs?v=1"), "200");
        assert_eq!(status("/s%72c/serve.rs"), "200");
        for outside in ["/../Cargo.toml", "/%2e%2e/Cargo.toml", "/src/../../Cargo.toml", "//etc/passwd", "/src/none.rs"]
        {
            assert_ne!(status(outside), "200", "{outside}");
        }
    }
}
