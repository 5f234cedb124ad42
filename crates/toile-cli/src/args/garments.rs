//! Garments and what each is made of: `--fabric` may follow each `--garment`.

use clap::error::ErrorKind;
use clap::{ArgMatches, Args, Command, Error, FromArgMatches};
use std::path::PathBuf;

/// What cloth is made of that nothing is said of.
const FABRIC: &str = "cotton";

/// The garments, inner ones first, and what each is made of.
#[derive(Clone, Debug)]
pub struct Garments {
    /// Files, each with the fabric that is named after it.
    pub files: Vec<(PathBuf, Option<String>)>,
    /// The fabric of all others.
    pub fabric: String,
}

#[derive(Args)]
struct GarmentOptions {
    /// Garment as GarmentCode JSON; repeat it to wear one over the other, inner ones first.
    #[arg(long, value_name = "FILE")]
    garment: Vec<PathBuf>,
    /// Fabric: the name of a preset or a TOML file, cotton without it. It belongs to the garment before it; one alone, before all garments or after them, to all.
    #[arg(long, value_name = "NAME|FILE")]
    fabric: Vec<String>,
}

impl Garments {
    /// Gives each fabric to its garment; both with their places among the words that were typed.
    fn of(garments: Vec<(usize, PathBuf)>, fabrics: Vec<(usize, String)>) -> Result<Self, String> {
        let places: Vec<usize> = garments.iter().map(|(place, _)| *place).collect();
        let mut files: Vec<_> = garments.into_iter().map(|(_, file)| (file, None)).collect();
        let mut common = None;
        let is_alone = fabrics.len() == 1;
        for (place, fabric) in fabrics {
            let before = places.iter().filter(|garment| **garment < place).count();
            let owner = match before {
                0 => &mut common,
                all if is_alone && all == files.len() => &mut common,
                _ => &mut files[before - 1].1,
            };
            if let Some(first) = owner.replace(fabric) {
                let second = owner.as_deref().unwrap_or_default();
                return Err(format!(
                    "--fabric {first} and --fabric {second} are both given for one garment: leave one out"
                ));
            }
        }
        Ok(Self { files, fabric: common.unwrap_or_else(|| FABRIC.to_owned()) })
    }
}

impl FromArgMatches for Garments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let GarmentOptions { garment, fabric } = GarmentOptions::from_arg_matches(matches)?;
        let places = |name| matches.indices_of(name).into_iter().flatten();
        let (garments, fabrics) = (places("garment").zip(garment), places("fabric").zip(fabric));
        Self::of(garments.collect(), fabrics.collect())
            .map_err(|message| Error::raw(ErrorKind::ArgumentConflict, format!("{message}\n")))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Garments {
    fn augment_args(command: Command) -> Command {
        GarmentOptions::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        GarmentOptions::augment_args_for_update(command)
    }
}

#[cfg(test)]
mod tests {
    use super::Garments;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Typed {
        #[command(flatten)]
        garments: Garments,
    }

    /// The fabric of each garment, then that of all others.
    fn fabrics(typed: &str) -> Result<Vec<String>, String> {
        let words = typed.split_whitespace().map(|word| match word {
            "g" => "--garment=file.json".to_owned(),
            fabric => format!("--fabric={fabric}"),
        });
        let typed = Typed::try_parse_from(std::iter::once("toile".to_owned()).chain(words));
        let Garments { files, fabric } = typed.map_err(|error| error.to_string())?.garments;
        Ok(files.into_iter().map(|(_, own)| own.unwrap_or_default()).chain([fabric]).collect())
    }

    #[test]
    fn a_fabric_belongs_to_the_garment_before_it() {
        for (typed, expected) in [
            ("", &["cotton"] as &[&str]),
            ("wool", &["wool"]),
            ("g g", &["", "", "cotton"]),
            ("g g wool", &["", "", "wool"]),
            ("wool g g", &["", "", "wool"]),
            ("g wool", &["", "wool"]),
            ("g wool g", &["wool", "", "cotton"]),
            ("g wool g silk", &["wool", "silk", "cotton"]),
            ("denim g g silk g", &["", "silk", "", "denim"]),
            ("denim g g silk", &["", "silk", "denim"]),
        ] {
            assert_eq!(fabrics(typed).expect("it is clear"), expected, "{typed}");
        }
        for typed in ["wool silk", "wool silk g", "g wool silk", "g g wool silk g"] {
            let error = fabrics(typed).expect_err("two for one");
            assert!(error.contains("--fabric wool and --fabric silk are both given for one garment"), "{error}");
        }
    }
}
