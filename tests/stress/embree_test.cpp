// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// The extreme scenes of the catalogue against Embree in robust mode. Where Embree names another
// triangle, both answers must be ones that rounding explains.
#include <gtest/gtest.h>

#include "stability/double_hit.h"
#include "stability/ray_scenes.h"
#include "support/embree_oracle.h"

namespace sheaf::stability {
namespace {

TEST(Embree, AgreesOnExtremeScenesButForWhatRoundingExplains) {
  for (const RayScene& source : ray_scenes()) {
    const MeshScene scene(source.mesh);
    const test::EmbreeOracle embree(scene.mesh.positions, scene.mesh.triangles);
    Random random(81);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = source.ray(scene, random);
      const Hit ours = trace_one(scene, ray, TraversalScheme::kMasked);
      ASSERT_TRUE(explains(scene, ray, ours)) << source.name << ": " << describe(ray);
      const test::EmbreeOracle::Hit theirs = embree.closest(ray);
      if (theirs.triangle == ours.triangle || theirs.triangle == kNoHit) continue;
      // Theirs may be wrong for its own reasons; it may not be surely nearer than ours.
      const DoubleHit other = hit_in_doubles(scene.records[theirs.triangle], ray);
      const bool surely_hit = other.margin > other.margin_error && other.t > other.t_error;
      const bool surely_nearer =
          ours.triangle == kNoHit || other.t + other.t_error < double{ours.t};
      ASSERT_FALSE(surely_hit && surely_nearer) << source.name << ": " << describe(ray);
    }
  }
}

}  // namespace
}  // namespace sheaf::stability
