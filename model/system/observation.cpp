// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/observation.h"

#include "system/machine.h"

namespace sheaf {

std::span<const Quantity> observed_quantities() {
  using enum Observed;
  static constexpr std::array kQuantities{
      Quantity{{"cycles", "cycles", "Length of the frame"}, kCycles},
      Quantity{{"dram_bytes", "bytes", "Bytes read from and written to DRAM"}, kDramBytes},
      Quantity{{"node_cache_hit_rate", "1", "Hits per access of all node caches"},
               kNodeHits,
               kNodeAccesses},
      Quantity{{"triangle_cache_hit_rate", "1", "Hits per access of all triangle caches"},
               kTriangleHits,
               kTriangleAccesses},
      Quantity{{"attribute_cache_hit_rate", "1", "Hits per access of all attribute caches"},
               kAttributeHits,
               kAttributeAccesses},
      Quantity{{"texture_cache_hit_rate", "1", "Hits per access of all texture caches"},
               kTextureHits,
               kTextureAccesses},
      Quantity{{"film_cache_hit_rate", "1", "Hits per access of the film's cache"},
               kFilmHits,
               kFilmAccesses},
      Quantity{{"l2_hit_rate", "1", "Hits per access of the L2"}, kL2Hits, kL2Accesses},
      Quantity{{"ray_cache_hit_rate", "1", "Rays that met an open cell, per ray"},
               kRayCacheHits,
               kRayCacheInsertions},
      Quantity{
          {"p_t_primary", "1", "p_t of primary rays"}, kPrimaryRayVisits, kPrimaryPacketVisits},
      Quantity{{"p_t_secondary", "1", "p_t of secondary rays"},
               kSecondaryRayVisits,
               kSecondaryPacketVisits}};
  return kQuantities;
}

Observation Machine::observation(Cycles now) const {
  using enum Observed;
  Observation seen;
  const auto add_cache = [&](const CacheStats& cache, Observed hits, Observed accesses) {
    seen[hits] += cache.num_hits;
    seen[accesses] += cache.num_accesses;
  };
  seen[kCycles] = now;
  const DramStats dram = memory_->dram().stats(now);
  seen[kDramBytes] = dram.bytes_read + dram.bytes_written;
  for (const auto& unit : traversal_units_) {
    add_cache(unit->cache().stats(), kNodeHits, kNodeAccesses);
    seen[kPrimaryRayVisits] += unit->primary_counts().lane_inner_visits;
    seen[kPrimaryPacketVisits] += unit->primary_counts().packet_inner_visits;
    seen[kSecondaryRayVisits] += unit->secondary_counts().lane_inner_visits;
    seen[kSecondaryPacketVisits] += unit->secondary_counts().packet_inner_visits;
  }
  for (const auto& unit : intersection_units_) {
    add_cache(unit->cache().stats(), kTriangleHits, kTriangleAccesses);
  }
  for (const auto& unit : shader_units_) {
    add_cache(unit->attribute_cache().stats(), kAttributeHits, kAttributeAccesses);
    const PrivateCache* texels = unit->texture_cache();
    if (texels != nullptr) add_cache(texels->stats(), kTextureHits, kTextureAccesses);
  }
  add_cache(film_->cache().stats(), kFilmHits, kFilmAccesses);
  seen[kL2Hits] = memory_->l2().stats().num_hits;
  seen[kL2Accesses] = memory_->l2().stats().num_accesses;
  if (ray_cache_) {
    seen[kRayCacheHits] = ray_cache_->sorter().stats().num_hits;
    seen[kRayCacheInsertions] = ray_cache_->sorter().stats().num_insertions;
  }
  return seen;
}

void Machine::load_caches(const TagHierarchy& tags) {
  using Cache = TagHierarchy::Cache;
  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    traversal_units_[i]->cache().load(tags.array(Cache::kNode, i));
  }
  for (std::size_t i = 0; i < intersection_units_.size(); ++i) {
    intersection_units_[i]->cache().load(tags.array(Cache::kTriangle, i));
  }
  for (std::size_t i = 0; i < shader_units_.size(); ++i) {
    shader_units_[i]->attribute_cache().load(tags.array(Cache::kAttribute, i));
    PrivateCache* const texels = shader_units_[i]->texture_cache();
    if (texels != nullptr) texels->load(tags.array(Cache::kTexture, i));
  }
  film_->cache().load(tags.array(Cache::kFilm, 0));
  memory_->l2().load(tags.l2_banks());
}

}  // namespace sheaf
