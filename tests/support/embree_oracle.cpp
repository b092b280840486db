// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/embree_oracle.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <stdexcept>

namespace sheaf::test {

struct EmbreeOracle::Handles {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = nullptr;
  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

RTCRay to_embree(const Ray& ray) {
  RTCRay out{};
  out.org_x = ray.origin.x;
  out.org_y = ray.origin.y;
  out.org_z = ray.origin.z;
  out.dir_x = ray.direction.x;
  out.dir_y = ray.direction.y;
  out.dir_z = ray.direction.z;
  out.tfar = ray.t_max;
  out.mask = ~0U;
  return out;
}

template <typename T>
void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::span<const T> from) {
  static_assert(sizeof(T) == 12);
  void* const to = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), from.size());
  if (to == nullptr) throw std::runtime_error("Embree: no memory for a buffer");
  std::memcpy(to, from.data(), from.size_bytes());
}

}  // namespace

EmbreeOracle::EmbreeOracle(std::span<const Vec3> positions,
                           std::span<const std::array<std::uint32_t, 3>> triangles, Mode mode)
    : handles_(std::make_unique<Handles>()) {
  if (handles_->device == nullptr) throw std::runtime_error("Embree: no device");
  handles_->scene = rtcNewScene(handles_->device);
  if (mode == Mode::kRobust) rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions);
  fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(handles_->scene);
  if (rtcGetDeviceError(handles_->device) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree: the scene was refused");
  }
}

EmbreeOracle::~EmbreeOracle() = default;

EmbreeOracle::Hit EmbreeOracle::closest(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.primID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {query.hit.primID, query.ray.tfar};
}

bool EmbreeOracle::occluded(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = to_embree(ray);
  rtcOccluded1(handles_->scene, &context, &query);
  return query.tfar < 0.0F;
}

}  // namespace sheaf::test
