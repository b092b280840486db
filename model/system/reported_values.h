// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stats/counters.h"

namespace sheaf {

// What a report says besides counters: formulas over counters, and facts about the run, the scene
// and the machine. Each is declared here, once.

#define SHEAF_RUN_VALUES(X)                                \
  X(scene, "", "Scene file")                               \
  X(config_hash, "", "Hash of the resolved configuration") \
  X(heuristic, "", "Sorting heuristic")                    \
  X(complete, "1", "1 if the frame is complete, 0 if partial")
SHEAF_VALUES(RunValues, SHEAF_RUN_VALUES);

#define SHEAF_REPLAY_VALUES(X)                                     \
  X(mode, "", "How a memory trace was replayed: elastic or fixed") \
  X(recorded_cycles, "cycles", "Length of the run that it was recorded from")
SHEAF_VALUES(ReplayValues, SHEAF_REPLAY_VALUES);

#define SHEAF_SCENE_VALUES(X)                             \
  X(triangles, "triangles", "Triangles after instancing") \
  X(vertices, "vertices", "Vertices")                     \
  X(materials, "materials", "Materials in use")           \
  X(lights, "lights", "Lights")
SHEAF_VALUES(SceneValues, SHEAF_SCENE_VALUES);

#define SHEAF_KDTREE_VALUES(X)                            \
  X(nodes, "nodes", "Nodes of the kd-tree")               \
  X(leaves, "nodes", "Leaves of the kd-tree")             \
  X(references, "triangles", "Entries in all leaf lists") \
  X(depth, "nodes", "Longest path")
SHEAF_VALUES(KdTreeValues, SHEAF_KDTREE_VALUES);

#define SHEAF_MEMORY_VALUES(X) \
  X(footprint, "bytes",        \
    "Simulated memory that tree, triangles, attributes, textures and frame buffer take")
SHEAF_VALUES(MemoryValues, SHEAF_MEMORY_VALUES);

#define SHEAF_RAY_VALUES(X)                                 \
  X(num_spawned, "rays", "Rays made by camera and shaders") \
  X(num_retired, "rays", "Of these, traced and shaded")     \
  X(num_hits, "rays", "Of these, hit something")
SHEAF_VALUES(RayValues, SHEAF_RAY_VALUES);

#define SHEAF_SYSTEM_VALUES(X)                                                              \
  X(cycles, "cycles", "Length of the run")                                                  \
  X(seconds, "s", "Length of the run in simulated time")                                    \
  X(frames_per_second, "1/s", "Frames per second of simulated time; 0 for a partial frame") \
  X(rays_per_cycle, "rays", "Rays retired per cycle")                                       \
  X(max_rays_in_flight, "rays",                                                             \
    "Most rays in the loop at a time, those in the ray cache included")                     \
  X(packets_made, "packets", "Most packets in flight at a time")                            \
  X(num_wakes, "events", "Times a unit was woken: the simulator's own work")
SHEAF_VALUES(SystemValues, SHEAF_SYSTEM_VALUES);

#define SHEAF_LINK_VALUES(X)                                                              \
  X(num_written, "messages", "Messages sent")                                             \
  X(max_occupancy, "messages", "Most messages on the way or waiting at a time")           \
  X(occupancy_cycles, "cycles", "Messages on the way or waiting, summed over all cycles") \
  X(mean_residence, "cycles", "Mean time from a message's writing to its reading")
SHEAF_VALUES(LinkValues, SHEAF_LINK_VALUES);

#define SHEAF_SORTER_VALUES(X)                            \
  X(hit_rate, "1", "Rays that met an open cell, per ray") \
  X(mean_cell_residence, "cycles", "Mean time from a cell's opening to its departure")
SHEAF_VALUES(SorterValues, SHEAF_SORTER_VALUES);

#define SHEAF_SPILL_VALUES(X) \
  X(mean_spill_latency, "cycles", "Mean time from a spilled bundle's arrival to its return")
SHEAF_VALUES(SpillValues, SHEAF_SPILL_VALUES);

#define SHEAF_SHADING_SORTER_VALUES(X)                                                          \
  X(hit_rate, "1", "Rays that met an open cell, per ray")                                       \
  X(rays_per_material_in, "rays", "Rays to be shaded per material of a packet, before sorting") \
  X(rays_per_material_out, "rays", "Rays to be shaded per material of a packet, after sorting")
SHEAF_VALUES(ShadingSorterValues, SHEAF_SHADING_SORTER_VALUES);

#define SHEAF_TRACE_VALUES(X)                                                                   \
  X(p_t, "1", "Inner nodes visited by the rays, each traced alone, per node visit of a packet") \
  X(p_i, "1", "Triangle tests of the rays, each traced alone, per test of a packet")
SHEAF_VALUES(TraceValues, SHEAF_TRACE_VALUES);

#define SHEAF_COHERENCE_VALUES(X)                                     \
  X(c_t, "1", "Visits of an inner node per distinct node of a scope") \
  X(c_i, "1", "Tests of a triangle per distinct triangle of a scope")
SHEAF_VALUES(CoherenceValues, SHEAF_COHERENCE_VALUES);

#define SHEAF_CACHE_VALUES(X) X(hit_rate, "1", "Hits per access; merges are no hits")
SHEAF_VALUES(CacheValues, SHEAF_CACHE_VALUES);

#define SHEAF_MAIN_MEMORY_VALUES(X)                                 \
  X(bytes_per_ray, "bytes", "Bytes moved to and from DRAM per ray") \
  X(bus_utilization, "1", "Share of cycles in which the data bus moved data")
SHEAF_VALUES(MainMemoryValues, SHEAF_MAIN_MEMORY_VALUES);

}  // namespace sheaf
