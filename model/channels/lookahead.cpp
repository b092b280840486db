// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "channels/lookahead.h"

#include <algorithm>

namespace sheaf {

void LinkMap::add(std::size_t from, std::size_t to, Cycles latency) {
  links_.push_back({from, to, latency, false});
}

// The known links, and those that must be assumed.
std::vector<LinkMap::Link> LinkMap::complete(std::size_t num_agents) const {
  std::vector<Link> links = links_;
  std::vector<bool> known(num_agents, false);
  for (const Link& link : links_) known[link.from] = true;
  for (std::size_t from = 0; from < num_agents; ++from) {
    for (std::size_t to = 0; to < num_agents && !known[from]; ++to)
      links.push_back({from, to, 1, true});
  }
  return links;
}

// Bellman and Ford's relaxation: there are a handful of agents and this is done once a link.
Reach LinkMap::reach(const std::vector<std::size_t>& last, std::size_t to,
                     std::size_t num_agents) const {
  const std::vector<Link> links = complete(num_agents);
  Reach reach(num_agents, kFarAway);
  for (const Link& link : links) {
    const bool is_last =
        link.assumed || std::find(last.begin(), last.end(), link.from) != last.end();
    if (link.to == to && is_last) reach[link.from] = std::min(reach[link.from], link.latency);
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Link& link : links) {
      const Cycles through = link.latency + reach[link.to];
      if (through >= reach[link.from]) continue;
      reach[link.from] = through;
      changed = true;
    }
  }
  return reach;
}

}  // namespace sheaf
