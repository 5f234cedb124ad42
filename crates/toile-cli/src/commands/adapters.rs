//! `toile adapters`.

use crate::adapter;
use crate::args::Adapters;
use crate::stdout::print;
use anyhow::{Result, bail};
use serde_json::json;

/// Lists the adapters; an error when there is none.
pub fn run(arguments: &Adapters) -> Result<()> {
    let adapters = adapter::all();
    let rows: Vec<_> = adapters
        .iter()
        .map(|adapter| {
            let info = adapter.get_info();
            let timestamps = adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY);
            let webgpu = adapter.get_downlevel_capabilities().is_webgpu_compliant();
            (info, timestamps, webgpu)
        })
        .collect();
    if arguments.json {
        let rows: Vec<_> = rows
            .iter()
            .map(|(info, timestamps, webgpu)| {
                json!({
                    "name": info.name,
                    "backend": info.backend.to_string(),
                    "type": format!("{:?}", info.device_type),
                    "driver": format!("{} {}", info.driver, info.driver_info),
                    "timestamps": timestamps,
                    "usable": webgpu,
                })
            })
            .collect();
        print(&serde_json::to_string_pretty(&rows)?)?;
    } else {
        for (info, timestamps, webgpu) in &rows {
            print(&format!(
                "{} · {} · {:?} · {} {}{}{}",
                info.name,
                info.backend,
                info.device_type,
                info.driver,
                info.driver_info,
                if *timestamps { " · timestamps" } else { "" },
                if *webgpu { "" } else { " · not usable: no compute" },
            ))?;
        }
    }
    if rows.iter().all(|(_, _, webgpu)| !webgpu) {
        bail!("no usable adapter was found: {}", adapter::INSTALL_HINT);
    }
    Ok(())
}
