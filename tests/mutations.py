# SPDX-License-Identifier: BSD-3-Clause
"""Break the program one term at a time: the tests that check the term must fail.

    python3 tests/mutations.py [--only TEXT] [--build DIR]
    python3 tests/mutations.py --check

Run by hand, not by ctest: a quarter of an hour on one core. Works on the last commit, in a clone in
a temporary folder, or in DIR, kept for the next time. --only takes the mutations whose name holds
TEXT. --check breaks nothing: it looks whether the table fits the sources as they stand. A mutation
is seen if of each of its test patterns at least one test fails. Prints a table
`mutation | tests that failed | verdict`; exit 1 if a mutation survives, 2 if the table no longer
fits the sources or if tests fail without any mutation.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIMEOUT = 900  # s for one call of a test program; what hangs has failed

PROGRAMS = {"V": "verification/verification", "W": "verification/verification_slow",
            "R": "verification/verification_reducibility"}
PROGRAMS |= {m: f"unit/unit_{m}" for m in ("core", "mesh", "fem", "contact", "dynamics", "statics",
                                           "reduction", "io", "study")}

SCRIPTS = {"cli": "test_run.py", "disk": "test_full_disk.py", "crush": "test_crush.py",
           "pod": "test_pod.py", "paper": "test_paper.py", "ring": "test_ring.py"}

# @file in src/rondo, then of each mutation in it: name | old text => new text | tests.
# \n is a new line; a line that begins with spaces continues the one above. The tests are
# program:filter, with the letters of PROGRAMS and gtest's filters, or cli:, disk:, crush:, pod:,
# paper: and ring:pattern (unittest's -k).
TABLE = r"""
@dynamics/ledger.cpp
V1 no W_scheme | scheme_.add(w.scheme); => |
  V:*Ledgers.*/as_printed* V:*Schemes.LedgerShows* dynamics:Stepper.Closes*
V1 D_mass won, not lost | w.dissipation_mass, => -w.dissipation_mass, | V:*Ledgers.*/plain*
V1 blind ledger | b.residual = rest.value(); => b.residual = 0.0; | V:LedgerCheck.*
@dynamics/stepper.cpp
reference: frame work without -s² | dot(mean, frame_acceleration(model, state, k)) =>
  dot(mean, frame_acceleration(model, state, k) +
  state.frame.spin * state.frame.spin * (model.reference[k] + state.u[k])) |
  dynamics:Stepper.Closes*
reference: frame work without Euler term | dot(mean, frame_acceleration(model, state, k)) =>
  dot(mean, frame_acceleration(model, state, k) -
  state.frame.spin_rate * turn90(model.reference[k] + state.u[k])) | dynamics:Stepper.Closes*
reference: frame work without pull | dot(mean, frame_acceleration(model, state, k)) =>
  dot(mean, frame_acceleration(model, state, k) - state.frame.pull) | dynamics:Stepper.Closes*
reference: sign of D_stiffness | dt * model.stiffness_damping * dot =>
  -dt * model.stiffness_damping * dot | dynamics:Stepper.Closes*
reference: D_mass with v⁻ only | printed ? v : mean) => v) | dynamics:Stepper.Closes*
reference: strain at one time | dot(state.u[k], state.force_before => dot(state.u[k], state.force |
  dynamics:Stepper.Closes*
reference: no stiffness damping | state.force[k] + model.stiffness_damping * stiffness_rate =>
  state.force[k] + 0.0 * stiffness_rate | dynamics:Stepper.Closes*
reference: half of the drag | dt * f - update => dt * f - 0.5 * update |
  dynamics:Stepper.Closes* dynamics:*MassDamping* dynamics:*AFree*
reference: sign of centrifugal term | {-f.spin * f.spin, f => {f.spin * f.spin, f | dynamics:*AFree*
reference: sign of Euler term | f.spin_rate} => -f.spin_rate} | dynamics:*AFree*
reference: sign of Coriolis term | state.frame.spin);\n  free => -state.frame.spin);\n  free |
  dynamics:*AFree*
reference: half of the Coriolis term |
  state.frame.spin);\n  free => 0.5 * state.frame.spin);\n  free | dynamics:*AFree*
reference: half of α | model.dt, model.mass => model.dt, 0.5 * model.mass | dynamics:*MassDamping*
reference: symplectic is as printed | (model.scheme, model.dt => (Scheme::as_printed, model.dt |
  dynamics:*MassDamping* dynamics:Stepper.Closes*
reference: as printed is symplectic | (model.scheme, model.dt => (Scheme::symplectic, model.dt |
  dynamics:Stepper.Closes*
reference: touching before the ground | (position(model, state, k)) =>
  (position(model, state, k) - Vec2{0.0, 0.01}) | dynamics:*ABall*
reference: step allocates | state.active.clear(); => state.active = State(model).active; |
  dynamics:Allocation.*
V1 step without increments | v + inverse * (model.dt * f - update.drag * v) =>
  inverse * (model.dt * f + (update.a - update.drag) * v) | W:*FreeSpin*
V10 start without u | state.u = std::move(u0); => state.u.assign(u0.size(), {}); | V:*SpinUp.Stationary* dynamics:*AFree*
start by a whole step | half = 0.5 * model.dt => half = model.dt | dynamics:*AFree*
clamped nodes move | v + (half => (state.v_next[0] = v) + (half | dynamics:*ClampedNodes*
@dynamics/step_context.cpp
fast: sign of the centrifugal term | .rate_x = -dt => .rate_x = dt | dynamics:*Operators*
fast: no Euler term | .rate_y = dt * f.spin_rate => .rate_y = 0.0 * f.spin_rate |
  dynamics:*Operators*
fast: no pull | .pull_y = dt * f.pull.y => .pull_y = 0.0 | dynamics:*Operators* V:FreeFall.*
fast: half of the drag | .drag_y = update.drag.y => .drag_y = 0.5 * update.drag.y |
  dynamics:*Operators* V:*Ledgers.*
fast: D_mass of the wrong mean | (printed ? 0.5 : 0.25) => 0.5 | V:*Ledgers.*/plain*
@dynamics/kernels/update.hpp
fast: strain at one time | add_dot(n.u, n.before, => add_dot(n.u, n.force, | V:*Ledgers.*/plain*
fast: no stiffness damping | fma(f.beta_over_dt, change.x, elastic.x) => elastic.x |
  dynamics:*Operators*
fast: steady steps of a changing spin | if constexpr (Unsteady) => if constexpr (false && Unsteady) |
  dynamics:*Operators*
@dynamics/kernels/cyclic.hpp
fast: last and next sector swapped | {next_x[i] - last_x[i], => {last_x[i] - next_x[i], |
  dynamics:*Operators*
fast: lanes past the last sector counted | if (sums && (pack + 1) * lanes > s.columns) => if (false) |
  dynamics:*Operators*
fast: last columns not looked at for contact | column < h.last; column += lanes =>
  column + lanes <= h.last; column += lanes | dynamics:*Operators*
@dynamics/cyclic_plan.cpp
fast: a step runs into the one before | needed = std::max(needed, e.column / kernels::most_rows); =>
  needed = 0; | dynamics:*CyclicCuts*
fast: mirrored with the wrong sign | .tr1 = 0.5 * (right[1] - left[1]) =>
  .tr1 = 0.5 * (left[1] - right[1]) | dynamics:*Operators*
@dynamics/cyclic_chunk.cpp
fast: edges of the same pass | double* left = edges_[pass % 2] => double* left = edges_[0] |
  dynamics:*CyclicCuts*
fast: no wrap around the ring | u[range_.columns] = u[0]; => | dynamics:*Operators*
fast: contact without u of the next step | put(t.row, work.next, t.column, u + model_.dt * v); => |
  dynamics:*Operators*
fast: halo contacts reported twice | if (t.column < 0 || t.column >= range_.columns) return; =>
  if (t.column >= range_.columns + 8) return; | dynamics:*CyclicCuts*
@dynamics/numbering.cpp
sparse: nodes as given | if (bandwidth(k, other).mean < bandwidth(k, nodes).mean) return other; => |
  dynamics:Numbering.TheWidth*
sparse: always another order | if (bandwidth(k, other).mean < bandwidth(k, nodes).mean) return other; =>
  return other; | dynamics:Numbering.AGood*
sparse: walks begin anywhere | node = end.node; => | dynamics:Numbering.AChain*
sparse: one connected part only | if (!walker.in_order(node)) walker => if (node == nodes[0]) walker |
  dynamics:Numbering.Parts*
@dynamics/sparse_plan.cpp
sparse: blocks transposed | {xx, xy, yx, yy} => {xx, yx, xy, yy} |
  dynamics:*Sparse.TheStep* dynamics:*Operators*
sparse: packs as long as a short row | row_length(k, a) > row_length(k, b) =>
  row_length(k, a) < row_length(k, b) | dynamics:*Sparse.TheStep*
@dynamics/sparse_integrator.cpp
sparse: the last pack is flung out | if (block + 1 == plan_.n_blocks) rest_padding(work.next); => |
  dynamics:SparsePadding.*
sparse: threads do not wait | if (n_threads > 1) barrier_.wait(static_cast<unsigned>(n_threads)); =>
  | dynamics:*SameBits*
sparse: contact without u of the next step | work.next[2 * c.row] = u.x; => | dynamics:*Operators*
sparse: sums without the impulse | correct_sums(*work.step, node, after, change, part.sums); =>
  static_cast<void>(change); | dynamics:*Sparse.TheStep* dynamics:*Operators*
sparse: contacts of an earlier step | std::fill(n_active_.begin(), n_active_.end(), 0); => |
  dynamics:*Operators*
@dynamics/kernels/sparse.hpp
sparse: kinetic energy without mass | sums.kinetic = fma(mass, pack.kinetic, sums.kinetic) =>
  sums.kinetic = sums.kinetic + pack.kinetic | dynamics:*Sparse.TheStep* dynamics:*Operators*
@dynamics/scheme.hpp
V12 as printed with a of symplectic | {{1.0, 0.0}, => {{1.0 + 0.5 * dt * alpha, dt * spin}, |
  V:*Schemes.AsPrintedGrows* V:*Ledgers.*/as_printed*
@dynamics/critical_step.cpp
V13 no damping in the step | xi * xi) + xi); => xi * 0.0)); | V:*Step.Formula* V:*Limit.*damped*
V13 step 3 % too long | step_of(out.o => step_of(0.97 * out.o | V:*Limit.*/plain* V:*Limit.*/all*
V13 step 3 % too short | step_of(out.o => step_of(1.03 * out.o | V:*Limit.*/plain* V:*Limit.*/all*
V13 residual subtracted | value + pair->residual => value - pair->residual | V:*Step.Frequency*
V13 element bound only | std::sqrt(pair->value + => std::sqrt(1e99 + | V:*Step.Frequency*
@dynamics/motion.cpp
V17 gravity upwards | Vec2{0.0, motion.gravity} => Vec2{0.0, -motion.gravity} | V:FreeFall.*
integral without slope | + 0.5 * slope(begin) * std::abs(part) => | dynamics:Table.Integrals*
height before t = 0 | length * height.slope(0.0) => 0.0 | dynamics:Motion.Kink*
turn before t = 0 | return from < 0.0 ? -prolonged => return false ? -prolonged | dynamics:*AFree*
spin rate at knots | (f.turn - f.turn_before) / (dt * dt) => -motion.angular_velocity.slope(t) |
  dynamics:*AFree*
sense of the angle | : -angular_velocity.integral => : angular_velocity.integral | dynamics:*Rolls*
@dynamics/contact_node.cpp
V1 contact work with v⁻ only | 0.5 * (node.before + after) => node.before | V:*Ledgers.*/friction*
V1 friction with w⁺ only | c.impulse.y * mean.y => c.impulse.y * c.after.y | V:*Ledgers.*/friction*
V18 i_c by R(θ_{n+2}) | conj(s.rotation) * impulse => conj(s.rotation_next) * impulse |
  V:*Rolling.*/frictionless*
V18 b without turn | s.rotation * (s.turn_minus_one * node.arm) / s.dt => Vec2{} |
  V:*Rolling.* dynamics:*LawVel*
V18 b linear in the turn | (rotation_minus_one(f.turn)), => (Vec2{0.0, f.turn}), | dynamics:*LawVel*
sign of the bounce | std::min(c.before.x, 0.0) => std::max(-c.before.x, 0.0) | dynamics:*ABall*
sticking by R(θ_{n+1}) | conj(s.rotation_next) * (c => conj(s.rotation) * (c | dynamics:*LawVel*
normals of a pair swapped | conj(a.normal) * b.normal => conj(b.normal) * a.normal |
  dynamics:Stepper.AConcave*
@contact/law.cpp
V18 sign of friction | {{rn, side => {{rn, -side |
  V:*Rolling.*/friction_2* V:*Rolling.*/friction_6* contact:Law.*
bounce in the law | problem.free.x + problem => problem.free.x - problem | contact:Law.*
slip without Im W | - side * friction * problem.delassus.y => | contact:Law.Holds*
@contact/residual.cpp
residual without its shift | + friction * std::abs(w.y), w.y} => , w.y} | contact:Residual.Sees*
projection off the cone's edge | / (1.0 + friction * friction) => | contact:Residual.Projection*
@contact/pair.cpp
pair without a single case | i = 0; i < 2; ++i) { => i = 1; i < 2; ++i) { | contact:Pair.Random*
pair without both pressing | both_press(p, choice); => | contact:Pair.Corner* contact:Pair.Random*
pair without bounce | p.turn.x * p.bounce[0] - p.bounce[1] => -p.bounce[1] | contact:Pair.Random*
pair always converged | residual <= tolerance} => true} | contact:Pair.Says*
@contact/ground.cpp
normal of the arc | r > 0.0 ? offset / r : f.normal => f.normal | contact:Ground.LedgeDistances
facet after a concave corner | if (facets_[k].concave_end) => if (false) | contact:Ground.*
facet before a concave corner | if (k > 0 && facets => if (false && facets | contact:Ground.*
touching before the ground | if (p.gap > 0.0) => if (p.gap > 0.01) | contact:Ground.Distance*
@statics/stationary_spin.cpp
V9 load without mass | m.array(); => m.mean(); | V:*Mesh.Displacement* V:*Mesh.NodalStress*
V9 no softening | m, free, spin * spin) => m, free, 0.0) | V:*Mesh.Displacement* statics:*Beyond*
eigenvalues_above: sign | (i, i) -= shift => (i, i) += shift | statics:*Beyond*
@statics/condensed_contact.cpp
crush sense of friction | stick.y > 0.0 ? friction => stick.y < 0.0 ? friction | statics:SolveBlock.*
crush slip without the mixed term | p.normal + edge * p.mixed => p.normal | statics:SolveBlock.*
crush direct solve without friction | if (edge(column) != 0.0) a.col => if (false) a.col |
  statics:Crush.ClosesIts*
@statics/condensation.cpp
crush sign of the tangent | c == 0 ? 1.0 : -1.0 => 1.0 | statics:Condensation.* statics:Crush.O*
crush old rows of an appended set | topRightCorner(old, size - old).transpose() =>
  topRightCorner(old, size - old).transpose() * 1.001 | statics:Condensation.* statics:Crush.ASet*
@statics/crush.cpp
crush slip since first touch | -displaced(model, set[j], state.u).y => 0.0 | statics:Crush.ClosesIts*
crush set never grows | if (!report.converged || outside.empty()) break; => break; |
  statics:Crush.ASet*
crush friction by the last force | (-mean.y * after.slip => (-after.force[k].y * after.slip |
  statics:Crush.ClosesIts*
crush blind balance | w.residual = w.strain - w.contact => w.residual = 0.0 | statics:Crush.Balance*
@fem/elasticity.cpp
V9 V14 d12 of plane strain | factor * nu, => factor * nu * nu, | V:*ClosedForm.* fem:Hooke.*
  V:Hertz.HalfWidth*
@fem/element.cpp
V17 weight of a Gauss point | k += g => k += (corner.x + corner.y > 1.0 ? 1.1 : 1.0) * g |
  V:*Patch.*/0 V:*Patch.*/4 V:*Mesh.Displacement*
V17 place of Gauss points | gauss = 1.0 / => gauss = 0.9 / | fem:Element.* V:*Rolling.*
V17 stiffness of triangles | 0.5 * g.jacobian => g.jacobian | V:*Patch.*/4
V17 mass of triangles | / 6.0 => / 3.0 | V:Mass.* fem:Element.Masses*
V17 mass of corners | (corners, corner_xi[a]) => (corners, 0.0 * corner_xi[a]) | fem:Element.Masses*
V17 stress at corners | reach = std::sqrt(3.0) => reach = 1.0 | fem:Element.*
V17 shear strain of quadrilaterals | dy * u[a].x + => dy * u[a].x - | V:*Patch.* fem:Element.Stress*
V17 shear strain of triangles | g.n[a].y * u[a].x + => g.n[a].y * u[a].x - | V:*Patch.* fem:Element.Stress*
@fem/assembly.cpp
V13 element bound too low | return solver.eig => return 0.5 * solver.eig | V:*.Frequency* fem:*ElementBoundIs*
element bound of whole cells only | std::any_of(cell => std::all_of(cell | fem:*ElementBoundOf*
@fem/harmonics.cpp
2.7 harmonics backwards | entry.odd += t.shift => entry.odd -= t.shift | fem:Harmonics.Product*
2.7 harmonics without their phase | factor * std::cos(kappa) => factor | fem:Harmonics.*
2.7 harmonics without masses | (root_mass[row] * root_mass[column]) => (root_mass[row] * root_mass[row]) |
  fem:Harmonics.Together*
2.7 harmonics not shifted | [j]] += shift; => [j]] += 0.0 * shift; | fem:Harmonics.Factor*
@dynamics/critical_step_sector.cpp
3.8 a harmonic is left out | i < count; => i < count - (count > 2); | dynamics:*BySectors.FindsIt*
3.8 harmonics met twice | while (std::gcd(stride, count) != 1) ++stride; => | dynamics:*BySectors.FindsIt*
3.8 the lower end | std::sqrt(largest.upper() => std::sqrt((1.0 - largest.width()) * largest.upper() |
  dynamics:*BySectors.Encloses*
3.8 a wide interval | enclosure_width = 1e-6 => enclosure_width = 1e-4 | dynamics:*BySectors.Encloses*
3.8 Lanczos of all but the last | k < harmonics.count(); => k < harmonics.count() - 1; |
  dynamics:*BySectors.LargeS*
3.8 Lanczos without its residual | (pair->value + pair->residual)) => (pair->value - pair->residual)) |
  dynamics:*BySectors.DoesNot*
3.8 proven by Lanczos | pair->value;\n    out.converged = => pair->value;\n    out.proven = out.converged = |
  dynamics:*BySectors.DoesNot*
@statics/stationary_spin_sector.cpp
6.1 LDL sees no negative pivot | final_ll = 1 => final_ll = 0 | statics:*BySectors.Beyond*
6.1 harmonic 1 is not looked at | positive_from(1) => positive_from(2) | statics:*BySectors.Sees*
6.1 harmonic N/2 is not looked at | k < harmonics_.count(); => k < harmonics_.count() - 1; |
  statics:*BySectors.Sees*
6.1 stationary sectors not turned | k.turn[j] * Vec2 => k.turn[0] * Vec2 | statics:*BySectors.IsThat*
6.1 stationary load without mass | load.cwiseProduct(root_mass);\n} => load;\n} | statics:*BySectors.Solves*
6.1 stationary without softening | factor(harmonics, spin * spin) => factor(harmonics, 0.0) |
  statics:*BySectors.IsThat* statics:*BySectors.Solves*
@fem/stress.cpp
V17 nodal stress no mean | weight[a] /= total => weight[a] *= 1.1 / total | V:*Patch.* fem:Stress*
@mesh/disk.cpp
tributary at the edges of lands | land_before ? 0.5 * => true ? 0.5 * | mesh:Disk.Tributary*
grading | , d.grading) => , 1.0) | mesh:Disk.Grading*
sector numbering | sector.push_back(pitch) => sector.push_back(line) | mesh:Disk.Sectors*
column 0 to the right | - 0.5 * std::numbers::pi; => ; | mesh:Disk.ColumnZero*
@io/results.cpp
time written first | check(s);\n => check(s);\n  row(d.time, s.time);\n | io:ResultsOfAKilledRun.*
times not NaN at first | d.time.write(view(never)); => | io:ResultsOfAKilledRun.*
stress turned backwards | cs * (s[0] - s[1]) + => cs * (s[1] - s[0]) + | io:Results.StressTurns*
crush labelled as a motion | if (c.quasi_static) {\n    time = => if (false) {\n    time = | crush:*labels*
traction not over length | / tributary[k]; => ; | io:Results.ContactForce*
@statics/lemke.cpp
6.4f ties left to chance | for (Index k = 0; k < n_ && rows.size() => for (Index k = 0; k < 0 && rows.size() |
  statics:Lemke.Kostreva*
@statics/condensed_contact.cpp
6.4f covering vector of ones | setConstant(1.0 / std::max(1.0, p.friction)) => setConstant(1.0) |
  statics:Pivoting.Covering*
6.4f is not called | pivot(p, solution.force, found, report); => ; | statics:Pivoting.Solves* crush:*by_pivoting
@reduction/rectify.cpp
7.3 rectified backwards | rotation(-harmonic * theta) => rotation(harmonic * theta) |
  reduction:Rectifier.OneSector* reduction:Rectifier.ATrans* reduction:Travelling.Vectors*
7.3 factors by 2 pi rounded | std::atan2(direction.y, direction.x) => std::remainder(theta, turn) |
  reduction:Rectifier.ATrans*
7.3 polar frames backwards | rotation(-turn * static_cast<double>(k) =>
  rotation(turn * static_cast<double>(k) | reduction:Rectifier.Commutes* reduction:Rectifier.ATrans*
@reduction/tsqr.cpp
7.2 modes not made orthonormal | orthonormalise(d.modes); => | reduction:Tsqr.*
7.2 second pass forgets a block | first, 0, n, kept), d.modes, 1.0, 1.0 =>
  first, 0, n, kept), d.modes, 1.0, 0.0 | reduction:Tsqr.Agrees*
@reduction/incremental.cpp
7.2 U is not mended | <= drift_allowed => >= 0.0 | reduction:Incremental.Within*
7.2 bound forgets a block | f.bound_squared += svd => f.bound_squared = svd |
  reduction:Incremental.BoundAdds*
7.2 V of the new snapshots | svd.v.block(k, 0, n, kept) => svd.v.block(0, 0, n, kept) |
  reduction:Incremental.*
@reduction/spectrum.cpp
7.2 discarded is 1 minus a sum | s.discarded[i] = tail.value() => s.discarded[i] = 1 - s.cumulative[i] |
  reduction:Spectrum.Discarded*
@reduction/decompose.cpp
7.2 round-off gives modes | (d.sigma.array() > least) => (d.sigma.array() >= 0.0 * least) |
  reduction:Tsqr.MakesNo* reduction:EveryMethod.Degenerate*
@io/run_reader.cpp
snapshots not written are read | times_.time.resize(n);\n => | io:RunReader.KilledRun*
masses not compared | if (const auto i = first_difference(run_a.mass(), run_b.mass()); i < n) =>
  if (const auto i = n; i < n) | io:MeshDifference.*
@io/h5.cpp
a part reads its whole row | name.c_str(), access.get())); => name.c_str(), H5P_DEFAULT)); |
  io:RunReader.APart*
@io/pod_files.cpp
coefficients without Σ | c.decomposition->sigma[at] : 1.0 => 1.0 : 1.0 | io:PodFiles.WhatWas*
POD written in place | folder(where / fmt::format(".pod.{}.tmp", ::getpid())), => folder(where), |
  io:PodFiles.Replace*
@study/toml_text.cpp
case writer drops a digit | ("{}", value) => ("{:.16g}", value) | study:WriteCase.Numbers*
@study/build.cpp
harmonics for all disks | .free.size() > harmonic_setup_dofs => .free.size() > 0 | study:Build.Small*
harmonics for no disk | return model.sector && => return false && | study:Build.LargeDisksAreSetUp*
harmonics undamped | (*m.sector, m.mass, damping => (*m.sector, m.mass, {} | study:Build.Mass* study:Build.LargeDisksAreSet*
softening by harmonics of another limit | shift = 4.0 * spin => shift = 1.0 * spin | study:Build.*Checked*
@study/case_values.cpp
unknown keys let through |
  add(value.key_place, path, found, unknown => static_cast<void>(unknown | study:*WrongCase.*
@study/observers.cpp
angle of the velocity at the snapshot | motion.angle(s.time_velocity) => motion.angle(s.time) |
  cli:*test_snapshots*
history of the last step | impulse_ += report.i => impulse_ = report.i | cli:*history_is*
@study/writer_thread.cpp
writer leaves out every other slot | (first_ready_ + 1) % => (first_ready_ + 2) % | study:WriterThread.WorksOff*
writer forgets the error of the last slot | join();\n  check(); => join(); |
  study:WriterThread.ErrorInTheLast* disk:last_rows
writer is killed with slots left | if (n_ready_ == 0) return; => if (closing_) return; | study:WriterThread.Destructor*
writer goes on after an error | while (!error_) { => while (true) { | study:WriterThread.DestructorJoins*
@study/run_output.cpp
writer rows wait for more | !rows_.empty() && Clock::now() - handed_over_ > longest_wait => false | study:RunOutputTest.ARow*
writer rows after their snapshot | slot.rows.swap(rows_); => if (!state) slot.rows.swap(rows_); | study:RunOutputTest.ASnapshot*
writer last rows stay behind | if (!rows_.empty()) push(nullptr);\n  const => const |
  study:RunOutputTest.Rows*
@study/crush_observers.cpp
crush rate without its increments | static_cast<double>(increments_) * (state => 1.0 * (state |
  crush:*snapshots_and*
crush force of the body on the ground | normal{0.0, 1.0} => normal{0.0, -1.0} | crush:*history*
@core/blas_threads.cpp
many BLAS threads | openblas_set_num_threads(1); => | cli:BlasThreads reduction:*SameBits*
@study/pod_snapshots.cpp
V19 no rectification | rectifier_->apply(column.angle, field); => | R:*smooth*rectified* pod:spectra
V19 rectified the other way | apply(column.angle, field) => apply(-column.angle, field) | R:*smooth*rectified* pod:spectra
POD weight not its root | root_.push_back(std::sqrt(weight_ => root_.push_back((weight_ | pod:spectra study:PodSnapshots.*
POD forces weighed by the mass | if (choice.weight == Weight::delassus) w = 1.0 / w; => | pod:spectra
POD forces turned as vectors | contact ? Components::scalars : => !contact ? Components::scalars : | pod:spectra
POD rows of another place | read_order(columns_[size(j)], place, count); => read_order(columns_[size(j)], 0, count); | study:PodSnapshots.Rows* pod:streams
POD blind to numbers not finite | if (!(std::abs(v.x) < largest && std::abs(v.y) < largest)) => if (v.x != v.x && false) | pod:damaged
POD fields in the order of the rings | const Index to = 2 * order_[i], from => const Index to = static_cast<Index>(2 * i), from | study:PodSnapshots.Unweight* pod:rebuild
POD weight none is two | w = 1.0;\n => w = 2.0;\n | pod:none
@study/pod_input.cpp
POD angle at the displacement's time | velocity && !of.angle_velocity.empty() ? of.angle_velocity : of.angle; => of.angle; | pod:spectra pod:angles
POD window without its end | times[j] <= to) => times[j] < to) | pod:window
POD shift by pitches is by harmonics | {"pitch", reduction::Shift::pitch} => {"pitch", reduction::Shift::fourier} | pod:pitches
POD time of the displacement | velocity ? of.time_velocity : of.time; => of.time; | study:PodSnapshots.Windows*
POD different meshes | if (!difference.empty()) => if (false) | pod:different
POD unfinished run unsaid | run.status() == "done") return; => true) return; | pod:unfinished
@study/pod_report.cpp
POD run errors of the first run | sums[columns[j].run] => sums[0] | study:PodSnapshots.Errors* pod:several
POD rank of what memory holds | rank_is_known = => rank_is_known = true || | pod:cut
POD errors of a mode less | static_cast<Index>(count.modes)); => static_cast<Index>(count.modes) - 1); | pod:several study:PodSnapshots.*
POD identity not judged | if (!(off <= bound)) => if (false) | study:PodTrouble.*
POD worst is the last | if (error <= report.worst_error && j > 0) continue; => | pod:files
@study/pod.cpp
POD rank unsaid | if (request.modes && *request.modes > r.modes) => if (false) | pod:rank
@study/pod_output.cpp
POD rebuilt from the first row | temporal.row(column) => temporal.row(0) | pod:rebuild
POD original weighted | snapshots.unweight(original.col(0)); => | pod:rebuild
@study/paper_jobs.cpp
paper another case is kept | text_of(directory / "case.toml") == write_case(c) && => | paper:another_case
paper a damaged run is kept | && is_whole(directory, j); => ; | paper:truncated
paper another program's run is kept | ended(j, run.may_fail) && is_of_this_program(j) && => ended(j, run.may_fail) && | paper:another_program
paper a failure of the machine is kept | && j.contains("steps_done") => | paper:machine
paper a POD of other weights is kept | text_in(j, "weight") == (pod.field == "contact" ? "delassus" : "mass") && => | paper:other_settings
paper a POD of other snapshots is kept | j.value("snapshots", 0LL) == run.value("snapshots", -1LL) && => | paper:other_settings
paper leftovers stay | if (entry.path().extension() == ".tmp") => if (false) | paper:leftovers
paper PODs of a run made again are kept | jobs[run].there && pod_is_there => pod_is_there | paper:damaged
paper nothing is kept | job.there = !again && run_is_there => job.there = again && run_is_there | paper:goes_on
paper the run that blows up is a failure | r.message, may_fail} => r.message, {}} | paper:every_row
paper stop unheard | options.stop = channel.stop(); => | paper:in_hand
@study/paper_results.cpp
paper means by row | const double w = f.length[k] * weight(k); => const double w = weight(k); |
  study:PaperResults.Means*
paper no number is swallowed | return a >= b || std::isnan(a) ? a : b; => return a < b ? b : a; | study:PaperResults.WhatIsNo*
paper a line twice as high | return 2.0 * std::abs(weighted => return 4.0 * std::abs(weighted |
  study:PaperResults.ALine*
paper rows that begin too early | if (before < from) continue; => if (time[k] < from) continue; |
  study:PaperResults.Means*
paper edge along x | Vec2{dot(u[i], outward), dot => Vec2{u[i].x, dot |
  study:PaperResults.Edge* paper:what_the_files
paper friction cone of half the angle | friction * f.x => 0.5 * friction * f.x | paper:every_row
@study/paper_plan.cpp
paper times of the snapshots | make.snapshots(480, 5) => make.snapshots(470, 5) | study:*Plan.TheLedge*
@study/paper_table.cpp
paper rows that are no number pass | return row.ours <= row.expected; => return !(row.ours > row.expected); |
  study:PaperTable.*
@study/paper.cpp
paper another study is taken over | if (quick != request.quick) => if (false) |
  paper:other_kind
paper two studies at once | const io::DirectoryLock lock(request.directory); => | paper:two_studies
"""


def table(tree, only):
    """[(name, path, old, new, [(program, filter)])]; each old text must be there exactly once."""
    rows, faults, path = [], [], None
    for line in TABLE.strip().replace("\n  ", " ").splitlines():
        if line.startswith("@"):
            path = tree / "src/rondo" / line[1:]
            continue
        name, change, tests = line.split(" | ")
        old, new = (part.strip().replace("\\n", "\n") for part in change.split("=>"))
        found = path.read_text().count(old)
        if found != 1:
            faults.append(f"{name}: found {found} times in {path.name}: {old!r}")
        if only in name:
            rows.append((name, path, old, new, [tuple(t.split(":", 1)) for t in tests.split()]))
    if faults or not rows:
        print(*faults or ["no mutation of that name"], sep="\n")
        sys.exit(2)
    return rows


def run(command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", **options)
    return done.returncode, done.stdout


def make(build, tests):
    targets = {pathlib.Path(PROGRAMS.get(program, "rondo")).name for program, _ in tests}
    return run(["cmake", "--build", build, "-j1", "--target", *sorted(targets)])


def failures(tree, build, program, pattern):
    """Names of the tests that fail, sorted."""
    command = [build / "tests" / PROGRAMS.get(program, ""), f"--gtest_filter={pattern}"]
    if program in SCRIPTS:
        command = ["/usr/bin/python3", tree / "tests/cli" / SCRIPTS[program], "-k", pattern]
    try:
        code, said = run(command, timeout=TIMEOUT,
                         env={**os.environ, "RONDO": str(build / "rondo")})
    except subprocess.TimeoutExpired:
        return [f"{program}:{pattern} (out of time)"]
    if re.search(r"Ran 0 tests|Running 0 tests", said):
        sys.exit(f"no test is called {program}:{pattern}")
    names = set(re.findall(r"^\[  FAILED  \] (\w\S*\.[^\s,]+)|^(?:FAIL|ERROR): (\w+)", said, re.M))
    names = sorted("".join(name) for name in names)
    return names or ([f"{program}:{pattern} (crash)"] if code else [])


def mutate(tree, build, row):
    """(tests that failed, verdict) of one mutation."""
    _, path, old, new, tests = row
    text = path.read_text()
    path.write_text(text.replace(old, new))
    try:
        if make(build, tests)[0]:
            return [], "DOES NOT BUILD"
        red = [failures(tree, build, *test) for test in tests]
    finally:
        path.write_text(text)
    unseen = [":".join(test) for test, names in zip(tests, red) if not names]
    return sum(red, []), "SURVIVES " + " ".join(unseen) if unseen else "seen"


def clone(folder):
    tree, build = folder / "source", folder / "build"
    if not tree.exists():
        subprocess.run(["git", "clone", "-q", ROOT, tree], check=True)
    subprocess.run(["git", "-C", tree, "fetch", "-q", "origin", "HEAD"], check=True)
    subprocess.run(["git", "-C", tree, "reset", "-q", "--hard", "FETCH_HEAD"], check=True)
    subprocess.run(["cmake", "-S", tree, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"],
                   check=True, stdout=subprocess.DEVNULL)
    return tree, build


def unmutated(tree, build, tests):
    """What is wrong without any mutation."""
    code, said = make(build, tests)
    return said if code else [name for test in tests for name in failures(tree, build, *test)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--only", default="", metavar="TEXT")
    parser.add_argument("--build", type=pathlib.Path, metavar="DIR")
    parser.add_argument("--check", action="store_true", help="only whether the table fits")
    given = parser.parse_args()
    if given.check:
        print(f"{len(table(ROOT, given.only))} mutations fit the sources")
        return 0
    with tempfile.TemporaryDirectory() as temporary:
        tree, build = clone((given.build or pathlib.Path(temporary)).resolve())
        rows = table(tree, given.only)
        wrong = unmutated(tree, build, sorted({test for row in rows for test in row[4]}))
        if wrong:
            print("without any mutation:", wrong)
            return 2
        print("mutation | tests that failed | verdict", flush=True)
        seen = 0
        for row in rows:
            red, verdict = mutate(tree, build, row)
            print(f"{row[0]} | {', '.join(red)} | {verdict}", flush=True)
            seen += verdict == "seen"
    print(f"{seen} of {len(rows)} mutations seen")
    return 0 if seen == len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
