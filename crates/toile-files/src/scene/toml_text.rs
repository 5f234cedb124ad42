//! TOML text with the place of each error, and keys that are set from outside.

use crate::error::{Found, Place};
use serde::de::DeserializeOwned;
use toml::{Table, Value};

/// Parses TOML into a type.
pub(crate) fn parse<T: DeserializeOwned>(text: &str) -> Result<T, Found> {
    toml::from_str(text).map_err(|error| {
        let place = match error.span() {
            Some(span) => {
                let before = &text[..text.floor_char_boundary(span.start)];
                let line_start = before.rfind('\n').map_or(0, |end| end + 1);
                let line = before.matches('\n').count() + 1;
                Place::Column(line, before[line_start..].chars().count() + 1)
            }
            None => Place::File,
        };
        Found::malformed(place, one_line(error.message()))
    })
}

/// Sets keys of a table that already parsed, and parses it again after each, so that an error names the key.
pub(crate) fn override_keys<T: DeserializeOwned>(text: &str, overrides: &[(String, String)]) -> Result<T, Found> {
    let mut parsed = parse(text)?;
    if overrides.is_empty() {
        return Ok(parsed);
    }
    let mut root = Value::Table(parse::<Table>(text)?);
    for (key, value) in overrides {
        let wrong = |message: &str| Found::malformed(Place::Key(key.clone()), one_line(message));
        set(&mut root, key, literal(value)).map_err(|message| wrong(&message))?;
        parsed = root.clone().try_into().map_err(|error: toml::de::Error| wrong(error.message()))?;
    }
    Ok(parsed)
}

/// The text as a TOML value, else as a string, so that names need no quotes.
fn literal(text: &str) -> Value {
    toml::from_str::<Table>(&format!("value = {text}"))
        .ok()
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| Value::String(text.into()))
}

fn set(root: &mut Value, key: &str, value: Value) -> Result<(), String> {
    let mut place = root;
    let mut names: Vec<&str> = key.split('.').collect();
    let last = names.pop().unwrap_or_default();
    for name in names {
        place = entry(place, name)?;
        // A fabric's name is short for a table with that base.
        if let Value::String(base) = place {
            let base = Value::String(std::mem::take(base));
            *place = Value::Table(Table::from_iter([("base".to_string(), base)]));
        }
    }
    *entry(place, last)? = value;
    Ok(())
}

/// The entry of a table, made if it is not there, or of an array by its number.
fn entry<'a>(place: &'a mut Value, name: &str) -> Result<&'a mut Value, String> {
    match place {
        Value::Table(table) => Ok(table.entry(name).or_insert_with(|| Value::Table(Table::new()))),
        Value::Array(entries) => {
            let count = entries.len();
            name.parse()
                .ok()
                .and_then(|index: usize| entries.get_mut(index))
                .ok_or_else(|| format!("\"{name}\" is not the number of an entry: there are {count}"))
        }
        _ => Err(format!("\"{name}\" cannot be set inside of a plain value")),
    }
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
