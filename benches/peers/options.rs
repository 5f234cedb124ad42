//! The options of the command line.

use std::path::PathBuf;
use toile_lab::peers::Trial;

/// What there is.
pub const HELP: &str = "\
options of `cargo bench --bench peers -- ...`:
  --make-environments   make the environments of the peers, with pip, and end
  --scene hang,ball     scenes
  --n 64,128            particles on a side
  --frames 60           frames, at least 4
  --repetitions 3       runs of each setting
  --limit 120           seconds after which a run is stopped
  --json FILE           figures, for programs
  --plot FILE           the plot, as SVG";

/// What is measured, and where it goes.
#[derive(Debug)]
pub struct Options {
    /// Whether environments are made, and nothing else done.
    pub make_environments: bool,
    /// Names of scenes.
    pub scenes: Vec<String>,
    /// Particles on a side.
    pub sizes: Vec<u32>,
    /// Frames of a run.
    pub frames: u32,
    /// Runs of each setting.
    pub repetitions: u32,
    /// Longest time of a run [s].
    pub limit: u64,
    /// Where the figures go.
    pub json: Option<PathBuf>,
    /// Where the plot goes.
    pub plot: Option<PathBuf>,
}

impl Options {
    /// The options among the arguments; `None` when help is asked for. cargo adds `--bench`, which says nothing.
    ///
    /// # Errors
    /// An option that there is not, or a value that it cannot have, in a line.
    pub fn read(arguments: impl Iterator<Item = String>) -> Result<Option<Self>, String> {
        let mut options = Self {
            make_environments: false,
            scenes: Trial::NAMES.map(str::to_owned).to_vec(),
            sizes: vec![64, 128],
            frames: 60,
            repetitions: 3,
            limit: 120,
            json: None,
            plot: None,
        };
        let mut arguments = arguments.filter(|argument| argument != "--bench");
        while let Some(option) = arguments.next() {
            let mut value = || arguments.next().ok_or_else(|| format!("{option} needs a value"));
            match option.as_str() {
                "--help" => return Ok(None),
                "--make-environments" => options.make_environments = true,
                "--scene" => options.scenes = value()?.split(',').map(str::to_owned).collect(),
                "--n" => {
                    options.sizes =
                        value()?.split(',').map(|n| number(&option, n, 3, 1024)).collect::<Result<_, _>>()?;
                }
                "--frames" => options.frames = number(&option, &value()?, 4, 6000)?,
                "--repetitions" => options.repetitions = number(&option, &value()?, 1, 100)?,
                "--limit" => options.limit = number(&option, &value()?, 1, 86_400)?.into(),
                "--json" => options.json = Some(value()?.into()),
                "--plot" => options.plot = Some(value()?.into()),
                _ => return Err(format!("there is no option {option}; `-- --help` says which there are")),
            }
        }
        match options.scenes.iter().find(|scene| !Trial::NAMES.contains(&scene.as_str())) {
            Some(scene) => Err(format!("there is no scene {scene}; the scenes are {}", Trial::NAMES.join(" and "))),
            None => Ok(Some(options)),
        }
    }
}

fn number(option: &str, text: &str, least: u32, most: u32) -> Result<u32, String> {
    let number = text.parse().ok().filter(|number| (least..=most).contains(number));
    number.ok_or_else(|| format!("{option} takes whole numbers from {least} to {most}, not {text}"))
}
