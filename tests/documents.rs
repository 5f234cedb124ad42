//! The pages of the repository: every link leads to a file that is there, and to a heading that it has. What they say of the code is so.

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every page that git may hold, and none of what is built.
fn pages() -> Vec<PathBuf> {
    let mut pages = Vec::new();
    let mut folders = vec![root().to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_symlink() || name.starts_with('.') || ["target", "out", "node_modules"].contains(&name.as_str())
            {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else if name.ends_with(".md") {
                pages.push(path);
            }
        }
    }
    pages
}

fn events(text: &str) -> impl Iterator<Item = Event<'_>> {
    Parser::new_ext(text, Options::ENABLE_TABLES)
}

/// Where a page links to, pictures among it, also those that are written as HTML.
fn links(text: &str) -> Vec<String> {
    let mut links = Vec::new();
    for event in events(text) {
        match event {
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => links.push(dest_url.to_string()),
            Event::Html(html) | Event::InlineHtml(html) => {
                let sources = html.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next());
                links.extend(sources.map(str::to_owned));
            }
            _ => {}
        }
    }
    links
}

/// What the headings of a page are called in links: small letters, words joined by hyphens, and nothing else.
fn anchors(text: &str) -> Vec<String> {
    let mut anchors = Vec::new();
    let mut heading: Option<String> = None;
    for event in events(text) {
        match event {
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::End(TagEnd::Heading(_)) => anchors.extend(heading.take()),
            Event::Text(words) | Event::Code(words) => {
                if let Some(heading) = &mut heading {
                    let kept = words.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
                    heading.extend(kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }));
                }
            }
            _ => {}
        }
    }
    anchors
}

/// The links of a page's text that lead nowhere.
fn dead(page: &Path, text: &str) -> Vec<String> {
    let leads = |link: &String| {
        let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
        let target = page.parent().expect("a page lies in a folder").join(file);
        if !file.is_empty() && !target.exists() {
            return false;
        }
        let heads = if file.is_empty() { text.to_owned() } else { fs::read_to_string(&target).unwrap_or_default() };
        anchor.is_empty() || anchors(&heads).iter().any(|heading| heading == anchor)
    };
    links(text).into_iter().filter(|link| !link.contains("://") && !leads(link)).collect()
}

#[test]
fn every_link_of_every_page_leads_somewhere() {
    let pages = pages();
    for page in ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "docs/hosting.md", "docs/decisions/README.md"] {
        assert!(pages.contains(&root().join(page)), "{page} is not read");
    }
    let mut faults = Vec::new();
    let mut count = 0;
    for page in &pages {
        let text = fs::read_to_string(page).expect("a page is text");
        count += links(&text).len();
        faults.extend(dead(page, &text).into_iter().map(|link| format!("{}: {link}", page.display())));
    }
    assert!(count > 60, "{count} links in {} pages", pages.len());
    assert!(faults.is_empty(), "links that lead nowhere: {faults:#?}");
}

#[test]
fn a_dead_link_of_every_kind_is_seen() {
    let page = root().join("docs/page.md");
    let text = "# A head, and `more`\n[a](hosting.md) [b](#a-head-and-more) [c](hosting.md#pipelines) ![d](dress.png)\n\n<img src=\"dress.png\">\n";
    assert_eq!(dead(&page, text), Vec::<String>::new());
    let faults = ["a.md", "#another", "hosting.md#no-head", "dress.gif", "e.png"];
    let text = format!(
        "| table |\n|---|\n| [a]({}) |\n\n[b]({}) [c]({}) ![d]({})\n\n<img src=\"{}\">\n",
        faults[0], faults[1], faults[2], faults[3], faults[4]
    );
    assert_eq!(dead(&page, &text), faults);
}

/// Every Rust file below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries
        .flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|ending| ending == "rs"))
        .collect()
}

/// Public structs that a host may write with all their fields.
fn open_structs(source: &str) -> Vec<String> {
    let mut open = Vec::new();
    let mut lines = source.lines();
    let mut is_closed = false;
    while let Some(line) = lines.next() {
        let Some(rest) = line.strip_prefix("pub struct ") else {
            is_closed = line == "#[non_exhaustive]" || is_closed && (line.starts_with("#[") || line.starts_with("///"));
            continue;
        };
        if rest.ends_with('{') && !is_closed {
            let mut fields = lines.by_ref().take_while(|line| *line != "}").map(str::trim);
            if fields.all(|line| line.starts_with("pub ") || line.starts_with("//") || line.starts_with("#[")) {
                let name = rest.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
                open.push(name.to_owned());
            }
        }
        is_closed = false;
    }
    open
}

#[test]
fn the_structs_with_open_fields_are_those_that_the_page_names() {
    let page = fs::read_to_string(root().join("docs/decisions/control.md")).expect("a page");
    let told = page.split("- Open are").nth(1).and_then(|rest| rest.split("\n- Ranges").next()).expect("it names them");
    let mut named: Vec<&str> = told.split('`').skip(1).step_by(2).collect();
    let crates = ["toile", "toile-scene", "toile-files", "toile-model", "toile-gpu"];
    let found = crates.map(|name| sources(&root().join("crates").join(name).join("src"))).concat();
    let mut open: Vec<String> =
        found.iter().flat_map(|path| open_structs(&fs::read_to_string(path).expect("a source"))).collect();
    named.sort_unstable();
    open.sort_unstable();
    assert_eq!(
        open, named,
        "a struct that may grow is #[non_exhaustive]; one whose fields are complete stands on the page"
    );
}

#[test]
fn a_struct_is_open_when_all_its_fields_are() {
    let source = "pub struct Open<'a> {\n    /// A field.\n    pub a: &'a f32,\n}\n#[non_exhaustive]\npub struct Closed {\n    pub a: f32,\n}\n\
        pub struct Private {\n    pub a: f32,\n    b: f32,\n}\n";
    assert_eq!(open_structs(source), ["Open"]);
}
