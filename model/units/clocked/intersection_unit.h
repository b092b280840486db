// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "units/clocked/context_unit.h"
#include "units/messages.h"
#include "units/traversal_unit.h"

namespace sheaf::clocked {

/// Tests packets against the triangles of a leaf: fetches the leaf's list, then for one triangle
/// after the other fetches its record and tests it.
class IntersectionUnit final : public ContextUnit {
 public:
  IntersectionUnit(std::string name, const UnitSpec& spec, std::uint32_t packet_size,
                   const TracedScene& scene, Cache cache);

  Inputs<LeafJob> in_jobs;                ///< one per traversal unit
  std::vector<Link<LeafDone>*> out_done;  ///< one per traversal unit

  [[nodiscard]] const Cache& cache() const { return cache_; }

 private:
  struct Job {
    LeafJob what;
    std::uint32_t tested = 0;
    bool has_list = false;
    bool issued = false;  ///< the fetch of the list, or a test, is in the pipeline
  };
  void accept(Cycles now) override;
  void resume(int context, Cycles now) override;
  void issue(int context, Cycles now) override;
  bool fetch_bytes(int context, Address first, Bytes bytes, DataKind kind, Cycles now);
  [[nodiscard]] Job& job(int context) { return jobs_[static_cast<std::size_t>(context)]; }

  const TracedScene scene_;
  Cache cache_;
  std::vector<Job> jobs_;
};

}  // namespace sheaf::clocked
