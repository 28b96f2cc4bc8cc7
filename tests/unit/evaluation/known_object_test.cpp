#include "core/evaluation/known_object.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/mesh/parts.hpp"
#include "core/progress/stopped.hpp"
#include "core/view/candidate_views.hpp"

namespace nextview {
namespace {

KnownObject known_sphere() {
  const TriangleMesh mesh = sphere_part().mesh;
  DepthCameraConfig camera;
  camera.width = 80, camera.height = 60;
  CandidateViewsConfig around;
  around.count = 60;
  const VoxelGrid grid{0.1, Eigen::Vector3i::Constant(-4), Eigen::Vector3i::Constant(8)};
  return {mesh,
          sample_surface(mesh, 2000, 1),
          std::make_shared<const MeshRayCaster>(mesh),
          DepthCamera(camera),
          candidate_views(around, Vector3::Zero()),
          grid,
          0.02,
          {}};
}

TEST(KnownObject, TellsHowFarItIsFromTheThreadThatAskedAndNeverGoesBack) {
  const KnownObject known = known_sphere();
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<int> elsewhere = 0;
  std::vector<double> told;
  const auto listen = [&](double fraction, std::string_view) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that other threads take part
    if (std::this_thread::get_id() != here)
      ++elsewhere;
    else
      told.push_back(fraction);
  };
  EXPECT_EQ(known.sight(listen).candidates.size(), 60u);
  EXPECT_EQ(elsewhere, 0);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_GT(told.front(), 0.0);
  EXPECT_LE(told.back(), 1.0);
}

TEST(KnownObject, WhatCandidatesSeeIsFoundByTheNextWhoAsksWhereTheFirstWasStopped) {
  const KnownObject known = known_sphere();
  std::stop_source stop;
  EXPECT_THROW(known.sight([&](double, std::string_view) { stop.request_stop(); }, stop.get_token()), Stopped);
  int told = 0;
  const auto listen = [&](double, std::string_view) { ++told; };
  const CandidateSight& sight = known.sight(listen);
  EXPECT_GT(told, 0) << "half of it was kept";
  for (std::size_t v = 0; v < sight.candidates.size(); ++v)
    EXPECT_EQ(sight.samples[v], known.samples_seen(sight.candidates[v])) << v;
  told = 0;
  EXPECT_EQ(&known.sight(listen), &sight);
  EXPECT_EQ(told, 0) << "it was looked for again";
}

}  // namespace
}  // namespace nextview
