// SPDX-License-Identifier: BSD-3-Clause
#include "simulation.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

#include "arrays.hpp"
#include "calls.hpp"
#include "matrices.hpp"
#include "options.hpp"
#include "rondo/analysis/simulation/drive.hpp"
#include "rondo/analysis/simulation/simulation.hpp"
#include "rondo/core/error.hpp"

namespace rondo::python {
namespace {

using study::Simulation;

constexpr double period_s = std::chrono::duration<double>(Call::period).count();

class Steps {
 public:
  Steps(const std::filesystem::path& file, const Settings& settings, study::RunOptions options) {
    options.warn = call_.warn();
    call_.work([&] {
      simulation_ = std::make_unique<Simulation>(study::read_case(file, settings), options);
    });
    call_.finish();
  }

  /// Of a process that was forked its files are the other one's: it is left as it is.
  ~Steps() {
    if (is_of_another_process()) static_cast<void>(simulation_.release());
  }
  Steps(const Steps&) = delete;
  Steps& operator=(const Steps&) = delete;

  /// @return how many steps were made
  long long advance(long long steps) {
    const Turn turn(busy_);
    Simulation& s = open();
    if (s.broken_by()) throw FileError(*s.broken_by());
    const long long begin = s.steps_made();
    s.aim(begin + std::min(steps, s.setup().n_steps - begin));
    for (;;) {
      bool there = false;
      call_.work([&] { there = s.go_on(period_s); });
      if (there || closing_.load() || is_ending()) break;
      if (PyErr_CheckSignals() == 0) continue;
      py::error_already_set interrupt;
      settle(s);
      throw interrupt;
    }
    call_.finish();
    return s.steps_made() - begin;
  }

  void drive(const std::vector<study::DrivenValue>& values, double over) {
    const Turn turn(busy_);
    open().drive(values, over);
    call_.finish();
  }
  double driven(const std::string& key) {
    const Turn turn(busy_);
    return any().driven(key);
  }
  std::vector<std::string> driven_keys() { return study::driven_keys(any().case_as_driven()); }
  std::string case_text() {
    const Turn turn(busy_);
    return study::write_case(any().case_as_driven());
  }

  /// None: they are not at hand.
  py::object field(std::vector<double> study::ShownFields::*which) {
    const Turn turn(busy_);
    const auto shown = any().fields();
    if (!shown) return py::none();
    return view(
        shown, ((*shown).*which).data(),
        {static_cast<py::ssize_t>(shown->nodes), static_cast<py::ssize_t>(shown->components)});
  }
  py::object contacts();
  py::object frame();

  py::dict operators() {
    const Turn turn(busy_);
    study::Operators found;
    call_.work([&] { found = study::make_operators(any().case_as_driven(), any().setup()); });
    call_.finish();
    return operator_arrays(found, any().setup());
  }
  py::tuple frame_at(double time) {
    const Turn turn(busy_);
    const dynamics::Model& model = any().setup().model;
    return frame_arrays(study::frame_at(model, time, "time"), model.components());
  }
  /// @param displacement (n, c), or nothing for 0
  py::dict contact_rows(double angle, const std::vector<double>& center,
                        const std::vector<double>& displacement) {
    const Turn turn(busy_);
    const dynamics::Model& model = any().setup().model;
    const FieldView u =
        displacement.empty() ? FieldView() : FieldView(displacement, model.components());
    return contact_arrays(
        study::contact_rows(any().case_as_driven(), model, {angle, center_of(center)}, u),
        model.components());
  }

  std::vector<double> row() {
    const Turn turn(busy_);
    return any().row();
  }
  std::vector<std::pair<std::string, std::string>> columns() {
    std::vector<std::pair<std::string, std::string>> names;
    for (const ColumnLabel& c : any().columns()) names.emplace_back(c.name, c.unit);
    return names;
  }
  /// (rows, columns) of a run in memory so far.
  py::object rows() {
    const Turn turn(busy_);
    const std::vector<double>* numbers = any().rows();
    if (!numbers) return py::none();
    const auto width = static_cast<py::ssize_t>(any().columns().size());
    return owned(*numbers, {static_cast<py::ssize_t>(numbers->size()) / width, width});
  }
  py::dict mesh() {
    const study::Setup& s = any().setup();
    const bool massless = dynamics::has_massless_contact(s.model);
    return mesh_arrays(s.mesh, massless ? s.model.lumped_mass : s.model.mass, s.model.free_body);
  }

  long long step() { return any().steps_made(); }
  long long n_steps() { return any().setup().n_steps; }
  double dt() { return any().setup().model.dt; }
  double time() { return any().end_time(); }
  bool is_over() { return finished_ || any().is_over(); }
  std::string trouble() { return any().trouble(); }
  std::string info() { return text_of(any().json()); }

  void save() {
    const Turn turn(busy_);
    if (!open().has_files())
      throw request_error("save", "", "a simulation in memory has no files to keep a checkpoint in",
                          "Simulation(case, output=DIRECTORY)");
    call_.work([&] { simulation_->save(); });
    call_.finish();
  }
  /// Another thread that is at work on it ends after its steps in hand.
  void close() {
    if (is_of_another_process()) return;
    const Turn turn(busy_, closing_);
    if (finished_) return;
    finished_ = true;
    call_.work([&] { static_cast<void>(simulation_->finish()); });
    call_.finish();
  }

 private:
  /// One thread at a time.
  class Turn {
   public:
    explicit Turn(std::atomic_flag& busy) : busy_(busy) {
      if (busy_.test_and_set())
        throw request_error("Simulation", "", "another thread is at work on this simulation",
                            "one thread for each simulation, or a lock around its calls");
    }
    /// Asks who is at work to end, and waits for that.
    Turn(std::atomic_flag& busy, std::atomic<bool>& closing) : busy_(busy) {
      closing.store(true);
      const py::gil_scoped_release release;
      while (busy_.test_and_set()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ~Turn() { busy_.clear(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    std::atomic_flag& busy_;
  };

  [[nodiscard]] bool is_of_another_process() const noexcept { return getpid() != process_; }
  Simulation& any() { return *simulation_; }
  Simulation& open() {
    if (is_of_another_process())
      throw request_error("Simulation", "", "is that of the process that this one was forked from",
                          "a Simulation made in this process");
    if (finished_)
      throw request_error("Simulation", "", "is closed, and makes no more steps",
                          "a new Simulation; of one with a results directory with resume=True");
    return *simulation_;
  }
  /// To a step whose state is at hand, and a checkpoint of it.
  void settle(Simulation& s) {
    call_.work([&] {
      s.aim(s.steps_made() + 1);
      while (!s.go_on(std::numeric_limits<double>::infinity())) {
      }
      if (s.keeps_checkpoints() && !s.is_over()) s.save();
    });
  }

  Call call_;
  std::unique_ptr<Simulation> simulation_;
  std::atomic_flag busy_ = ATOMIC_FLAG_INIT;
  std::atomic<bool> closing_{false};
  bool finished_ = false;
  const pid_t process_ = getpid();
};

/// Nodes that touched something in the last step: node, normal and tangential force, gap, sticks.
py::object Steps::contacts() {
  const Turn turn(busy_);
  const dynamics::State* state = any().state();
  if (!state) return py::none();
  const study::Setup& s = any().setup();
  const bool solid = s.model.solid.has_value();
  std::vector<int> nodes, sticks;
  std::vector<double> force, gap;
  for (const dynamics::ActiveContact& c : state->active) {
    nodes.push_back(s.mesh.boundary[c.candidate]);
    force.insert(force.end(), {c.impulse.x / s.model.dt, c.impulse.y / s.model.dt});
    if (solid) force.push_back(c.impulse.z / s.model.dt);
    gap.push_back(c.gap);
    sticks.push_back(c.status == contact::Status::stick ? 1 : 0);
  }
  const auto n = static_cast<py::ssize_t>(nodes.size());
  return py::make_tuple(owned(std::move(nodes)), owned(std::move(force), {n, solid ? 3 : 2}),
                        owned(std::move(gap)), owned(std::move(sticks)));
}

/// Angle and center (x, y, or along t1, n, t2) at the time of the displacement.
py::object Steps::frame() {
  const Turn turn(busy_);
  const dynamics::State* state = any().state();
  if (!state) return py::none();
  const dynamics::FrameStep& f = state->frame;
  std::vector<double> center{f.center.x, f.center.y};
  if (any().setup().model.solid) center.push_back(f.center.z);
  return py::make_tuple(f.angle, owned(std::move(center)));
}

study::RunOptions options_of(const std::filesystem::path& output, const py::dict& given) {
  study::RunOptions options;
  take_options(given, run_options(options));
  options.directory = output;
  return options;
}

}  // namespace

void add_simulation(py::module_& module) {
  py::class_<Steps>(module, "Steps")
      .def(py::init([](const std::filesystem::path& file, const Settings& settings,
                       const std::filesystem::path& output, const py::dict& options) {
             return std::make_unique<Steps>(file, settings, options_of(output, options));
           }),
           py::arg("file"), py::arg("settings"), py::arg("output"), py::arg("options"))
      .def("advance", &Steps::advance, py::arg("steps"))
      .def("drive", &Steps::drive, py::arg("values"), py::arg("over"))
      .def("driven", &Steps::driven, py::arg("key"))
      .def("driven_keys", &Steps::driven_keys)
      .def("case_text", &Steps::case_text)
      .def("displacement", [](Steps& s) { return s.field(&study::ShownFields::displacement); })
      .def("velocity", [](Steps& s) { return s.field(&study::ShownFields::velocity); })
      .def("contacts", &Steps::contacts)
      .def("frame", &Steps::frame)
      .def("operators", &Steps::operators)
      .def("frame_at", &Steps::frame_at, py::arg("time"))
      .def("contact_rows", &Steps::contact_rows, py::arg("angle"), py::arg("center"),
           py::arg("displacement"))
      .def("row", &Steps::row)
      .def("columns", &Steps::columns)
      .def("rows", &Steps::rows)
      .def("mesh", &Steps::mesh)
      .def("step", &Steps::step)
      .def("n_steps", &Steps::n_steps)
      .def("dt", &Steps::dt)
      .def("time", &Steps::time)
      .def("is_over", &Steps::is_over)
      .def("trouble", &Steps::trouble)
      .def("info", &Steps::info)
      .def("save", &Steps::save)
      .def("close", &Steps::close);
}

}  // namespace rondo::python
