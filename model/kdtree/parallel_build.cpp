// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/parallel_build.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "base/helper_threads.h"
#include "base/huge_pages.h"
#include "kdtree/tree_output.h"

namespace sheaf {
namespace {

// A node of the upper tree: either split, with two children, or built as a whole subtree.
struct Job {
  PendingNode node;
  std::unique_ptr<SplitEvent[]> memory;  // of the node's events
  SplitPlane plane;
  std::unique_ptr<Job> left, right;
  KdTree subtree;
};

// Jobs to be done, until none is left and none is running that could add more.
class JobQueue {
 public:
  explicit JobQueue(Job& root) : jobs_{&root} {}

  // The next job; null when all are done or one has failed.
  Job* take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !jobs_.empty() || unfinished_ == 0 || failure_; });
    if (jobs_.empty() || failure_) return nullptr;
    Job* const job = jobs_.front();
    jobs_.pop_front();
    return job;
  }

  void finish(const Job& job) {
    const std::lock_guard lock(mutex_);
    for (Job* child : {job.left.get(), job.right.get()}) {
      if (child == nullptr) continue;
      jobs_.push_back(child);
      ++unfinished_;
    }
    --unfinished_;
    changed_.notify_all();
  }

  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    changed_.notify_all();
  }

  void rethrow_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job*> jobs_;
  std::size_t unfinished_ = 1;
  std::exception_ptr failure_;
};

std::unique_ptr<Job> make_child(const Job& parent, const Box& cell, std::size_t num_triangles) {
  auto job = std::make_unique<Job>();
  job->memory = std::make_unique_for_overwrite<SplitEvent[]>(node_events_room(num_triangles));
  job->node = {lay_node_events(job->memory.get(), num_triangles), cell, parent.node.depth + 1};
  return job;
}

void do_job(Job& job, SubtreeBuilder& builder, std::size_t max_subtree) {
  const bool whole = job.node.events.num_triangles <= max_subtree;
  if (!whole) job.plane = builder.choose_split(job.node);
  if (!job.plane.found()) {
    builder.build(job.node, job.subtree);
  } else {
    EventSplitter& splitter = builder.splitter();
    splitter.classify(job.node.events, job.node.cell, job.plane);
    const auto [left_cell, right_cell] = split_cell(job.node.cell, job.plane);
    job.left = make_child(job, left_cell, splitter.num_left());
    job.right = make_child(job, right_cell, splitter.num_right());
    splitter.distribute(job.node.events, job.left->node.events, job.right->node.events);
  }
  job.memory.reset();
}

void append_subtree(const KdTree& subtree, KdTree& tree) {
  check_room(tree, subtree.nodes.size(), subtree.leaf_triangles.size());
  const auto node_offset = static_cast<std::uint32_t>(tree.nodes.size());
  const auto list_offset = static_cast<std::uint32_t>(tree.leaf_triangles.size());
  for (const KdNode& node : subtree.nodes) {
    tree.nodes.push_back(node.is_leaf() ? KdNode::leaf(node.first() + list_offset, node.count())
                                        : KdNode::inner(node.axis(), node.split(),
                                                        node.right_child() + node_offset));
  }
  tree.leaf_triangles.insert(tree.leaf_triangles.end(), subtree.leaf_triangles.begin(),
                             subtree.leaf_triangles.end());
  tree.depth = std::max(tree.depth, subtree.depth);
}

// Counts the nodes and leaf entries that join() will append.
void count_output(const Job& job, std::size_t& num_nodes, std::size_t& num_entries) {
  if (job.plane.found()) {
    ++num_nodes;
    count_output(*job.left, num_nodes, num_entries);
    count_output(*job.right, num_nodes, num_entries);
  } else {
    num_nodes += job.subtree.nodes.size();
    num_entries += job.subtree.leaf_triangles.size();
  }
}

// Appends what the job has built and frees it.
void join(std::unique_ptr<Job> job, KdTree& tree) {
  if (!job->plane.found()) {
    append_subtree(job->subtree, tree);
    return;
  }
  const std::uint32_t inner = append_inner(tree, job->plane);
  join(std::move(job->left), tree);
  set_right_child(tree, inner);
  join(std::move(job->right), tree);
}

}  // namespace

void build_in_parallel(const MeshView& mesh, const SahCosts& costs, int max_depth, unsigned threads,
                       const PendingNode& root, std::unique_ptr<SplitEvent[]> memory,
                       KdTree& tree) {
  // Small enough that the last subtrees to be finished keep no thread waiting for long.
  const std::size_t max_subtree =
      std::max<std::size_t>(1024, root.events.num_triangles / (16 * std::size_t{threads}));
  auto root_job = std::make_unique<Job>();
  root_job->node = root;
  root_job->memory = std::move(memory);
  JobQueue queue(*root_job);
  const auto work = [&] {
    try {
      SubtreeBuilder builder(mesh, costs, max_depth);
      while (Job* job = queue.take()) {
        do_job(*job, builder, max_subtree);
        queue.finish(*job);
      }
    } catch (...) {
      queue.fail(std::current_exception());
    }
  };
  {
    const std::vector<std::jthread> helpers = start_helpers(threads - 1, work);
    work();
  }
  queue.rethrow_failure();
  std::size_t num_nodes = 0;
  std::size_t num_entries = 0;
  count_output(*root_job, num_nodes, num_entries);
  reserve_on_huge_pages(tree.nodes, num_nodes);
  reserve_on_huge_pages(tree.leaf_triangles, num_entries);
  join(std::move(root_job), tree);
}

}  // namespace sheaf
