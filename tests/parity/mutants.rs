//! Mistakes that a hand makes, in every place of a WGSL text where it can: a sign, a comparison, a min for a max, a constant, an index.

/// One mistake.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Mutant {
    /// The line as it should be, without indent and comment.
    pub line: String,
    /// The line with the mistake.
    pub wrong: String,
    /// What kind of mistake it is.
    pub kind: Kind,
}

/// Kinds of mistakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A sign flipped.
    Sign,
    /// A comparison that takes the border in, or leaves it out.
    Border,
    /// A comparison turned.
    Turned,
    /// The smaller for the larger.
    Extreme,
    /// Another number.
    Constant,
    /// The item after the one that is meant.
    Index,
}

/// A part of a line and what stands there by mistake.
type Change = (usize, usize, String, Kind);

/// Every mistake that a source can have, with the whole text that has it.
pub fn mutants(source: &str) -> Vec<(Mutant, String)> {
    let lines: Vec<&str> = source.lines().collect();
    let mut all = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        for (start, end, put, kind) in changes(code) {
            let wrong = format!("{}{put}{}", &code[..start], &code[end..]);
            let mutant = Mutant { line: code.trim().to_owned(), wrong: wrong.trim().to_owned(), kind };
            let mut text = lines.clone();
            text[number] = &wrong;
            all.push((mutant, text.join("\n")));
        }
    }
    all
}

fn changes(code: &str) -> Vec<Change> {
    let trimmed = code.trim_start();
    if ["@", "struct ", "fn ", "var<"].iter().any(|declares| trimmed.starts_with(declares)) {
        return Vec::new();
    }
    [signs(code), comparisons(code), extremes(code), constants(code), indices(code)].concat()
}

fn signs(code: &str) -> Vec<Change> {
    let unary = code.match_indices('-').filter(|(i, _)| !code[i + 1..].starts_with([' ', '>', '-', '=']));
    let unary = unary.filter(|(i, _)| !code[..*i].ends_with('-')).map(|(i, _)| (i, i + 1, String::new(), Kind::Sign));
    unary.chain(words(code, &[(" + ", " - "), (" - ", " + ")], Kind::Sign)).collect()
}

fn comparisons(code: &str) -> Vec<Change> {
    let border = [(" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > ")];
    let turned =
        [(" < ", " > "), (" <= ", " >= "), (" > ", " < "), (" >= ", " <= "), (" == ", " != "), (" != ", " == ")];
    let loops = code.trim_start().starts_with("for ");
    // A loop that is turned, or goes down to a border below which no whole number lies, has no end.
    let mut all = words(code, &border, Kind::Border);
    all.extend(words(code, &turned, Kind::Turned));
    all.retain(|(start, _, _, kind)| !loops || (*kind == Kind::Border && !code[*start..].starts_with(" > ")));
    all
}

fn extremes(code: &str) -> Vec<Change> {
    let mut all = words(code, &[("min(", "max("), ("max(", "min(")], Kind::Extreme);
    all.retain(|(start, ..)| !code[..*start].ends_with(is_of_a_name));
    all
}

fn constants(code: &str) -> Vec<Change> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(start) = code[at..].find(|c: char| c.is_ascii_digit()).map(|place| at + place) {
        let length = code[start..].find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(code.len() - start);
        let end = start + length;
        at = code[end..].find(|c: char| !is_of_a_name(c)).map_or(code.len(), |place| end + place);
        let suffixed = at - end;
        // Digits of a name, and bits.
        if code[..start].ends_with(is_of_a_name) || suffixed > 1 {
            continue;
        }
        let number = &code[start..end];
        let other = match number.parse::<u32>() {
            Ok(whole) => (whole + 1).to_string(),
            Err(_) => match number.parse::<f32>() {
                Ok(0.0) => "1e9".to_owned(),
                Ok(real) => format!("{:?}", real * 1.5),
                Err(_) => continue,
            },
        };
        found.push((start, end, other, Kind::Constant));
    }
    found
}

fn indices(code: &str) -> Vec<Change> {
    // What stands in brackets, and what a function is asked of.
    let mut open = Vec::new();
    let mut found = Vec::new();
    for (place, sign) in code.char_indices() {
        match sign {
            '[' => open.push(true),
            '(' => open.push(code[..place].ends_with("_of")),
            ']' | ')' if open.pop() == Some(true) => found.push((place, place, " + 1".to_owned(), Kind::Index)),
            _ => {}
        }
    }
    found
}

fn words(code: &str, pairs: &[(&str, &str)], kind: Kind) -> Vec<Change> {
    let of = |(word, other): &(&str, &str)| -> Vec<Change> {
        code.match_indices(word).map(|(start, _)| (start, start + word.len(), other.to_string(), kind)).collect()
    };
    pairs.iter().flat_map(of).collect()
}

fn is_of_a_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}
