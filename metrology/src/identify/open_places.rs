//! Places that a map leaves open: contacts at unknown points, and what is fitted for the machine as
//! specified before measurements are compared with it.

use abbe::Component;
use abbe::identify::{Failure, Fit, Fixture, Measurement, Options, Unknown};

use super::fitted::{
    fitted_fixture, fitted_intrinsics, fitted_mountings, fitted_stations, fitted_targets, fitted_zero,
};
use super::priors::{Prior, fit_with_places};
use super::setup::Setup;
use crate::data::{Data, Map};
use abbe_study::{About, Result};

impl Setup<'_> {
    /// Places the contacts at unknown positions at the mean position of their target by the machine
    /// as specified.
    pub(super) fn place_fixtures(&mut self, map: &Map, data: &Data) -> Result<(), Failure> {
        let Some(all) = map.instruments() else { return Ok(()) };
        for instrument in all.at_unknown_positions() {
            let Some(fixture) = all.fixture_of(instrument) else { continue };
            let own = all.list[instrument].observables.clone();
            let (mut sum, mut count) = ([0.0; 3], 0.0);
            let mut at = self.real.at(&[]);
            for row in &data.observations {
                let Measurement::Readings(readings) = &row.measured else { continue };
                if readings[own.clone()].iter().all(Option::is_some) {
                    let off = at.values(row)?;
                    sum.iter_mut().zip(&off[own.clone()]).for_each(|(sum, off)| *sum += off);
                    count += 1.0;
                }
            }
            if count > 0.0 {
                let place = self.real.fixtures[fixture].geometry.displaced(&sum.map(|sum| sum / count));
                self.models().into_iter().for_each(|model| model.fixtures[fixture].geometry = place);
            }
        }
        Ok(())
    }

    /// Fits the stations and the places on the tool that the map does not state, the fixtures and
    /// zeros that were not identified before, and likewise the mounting and the intrinsic
    /// parameters of a camera, for the machine as specified. Returns their fit; none if there was
    /// nothing to fit.
    pub(crate) fn find_places(&mut self, map: &Map, data: &Data) -> Result<Option<Fit>> {
        let stations = (0..self.open.stations.len()).filter(|i| self.open.stations[*i]);
        let stations = stations.flat_map(|i| Component::ALL.map(|component| Unknown::Base(i, component)));
        let stations: Vec<Unknown> = stations.collect();
        let camera = self.camera_to_find(map);
        let unknowns = [stations, self.tool_to_find(), camera, self.fixtures_to_find(map)].concat();
        if unknowns.is_empty() {
            return Ok(None);
        }
        if self.real.camera.is_some() && unknowns.iter().any(|unknown| unknown.is_tool()) {
            self.come_near(data).about(&data.file)?;
        }
        let model = self.real.with(unknowns);
        let priors = Prior::Auto.for_model(&model, self).about(&data.file)?;
        let options = Options { priors, ..Options::default() };
        let fit = fit_with_places(&model, &data.observations, options).about(&data.file)?;
        self.set_stations(&fitted_stations(&model, &fit.x));
        let fixtures = (0..model.fixtures.len())
            .map(|i| Fixture { geometry: fitted_fixture(&model, &fit.x, i), ..model.fixtures[i].clone() });
        let fixtures: Vec<Fixture> = fixtures.collect();
        let zeros: Vec<f64> = (0..model.observables.len()).map(|i| fitted_zero(&model, &fit.x, i)).collect();
        let (targets, mountings) = (fitted_targets(&model, &fit.x), fitted_mountings(&model, &fit.x));
        let intrinsics = fitted_intrinsics(&model, &fit.x);
        for model in self.models() {
            model.fixtures.clone_from(&fixtures);
            model.observables.iter_mut().zip(&zeros).for_each(|(reading, zero)| reading.zero = *zero);
            model.targets.clone_from(&targets);
            model.mountings.clone_from(&mountings);
            if let (Some(camera), Some(intrinsics)) = (&mut model.camera, intrinsics) {
                camera.intrinsics = intrinsics;
            }
        }
        Ok(Some(fit))
    }

    /// Returns the unknowns of the places on the tool that are open.
    fn tool_to_find(&self) -> Vec<Unknown> {
        let targets = (0..self.open.targets.len()).filter(|j| self.open.targets[*j]);
        let targets = targets.flat_map(|j| [0, 1, 2].map(|axis| Unknown::Target(j, axis)));
        let mountings = (0..self.open.mountings.len()).filter(|i| self.open.mountings[*i]);
        let mountings = mountings.flat_map(|i| Component::ALL.map(|component| Unknown::Tool(i, component)));
        targets.chain(mountings).collect()
    }

    /// Returns the unknowns of a camera that were not identified before: no drawing states where it
    /// is on the tool.
    fn camera_to_find(&self, map: &Map) -> Vec<Unknown> {
        let Some(all) = map.instruments().filter(|all| all.camera.is_some()) else { return Vec::new() };
        let is_placed = map.stated_mounting("").is_some() || self.placement;
        let is_found = !all.found.is_empty();
        let mut unknowns = self.real.base_and_tool(true);
        unknowns.retain(|unknown| match unknown {
            Unknown::Tool(..) => !is_placed,
            Unknown::Intrinsic(_) => !is_found,
            _ => false,
        });
        unknowns
    }

    /// Returns the unknowns of fixtures and zeros that were not identified before.
    fn fixtures_to_find(&self, map: &Map) -> Vec<Unknown> {
        let Some(all) = map.instruments() else { return Vec::new() };
        let unknowns = (0..all.list.len()).filter(|i| !all.found.contains(i)).flat_map(|i| {
            let place = all.fixture_of(i).into_iter().flat_map(|fixture| {
                let count = self.real.fixtures[fixture].geometry.unknowns();
                (0..count).map(move |coordinate| Unknown::Fixture(fixture, coordinate))
            });
            let zeros =
                all.list[i].observables.clone().filter(|reading| !self.real.observables[*reading].zero_known);
            place.chain(zeros.map(Unknown::Zero)).collect::<Vec<_>>()
        });
        unknowns.collect()
    }
}
