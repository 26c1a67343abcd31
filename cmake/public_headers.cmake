# SPDX-License-Identifier: BSD-3-Clause
# What is installed of src/rondo: docs/library.md names the first list, whose headers include those
# of the second. house_install compiles all of them together against what is installed, and by itself each one
# that no source of the library includes before all others.
set(RONDO_PUBLIC_HEADERS
    core/error.hpp core/version.hpp case/case.hpp case/setup.hpp
    output/run_options.hpp analysis/run.hpp analysis/build/build.hpp analysis/modes/modes.hpp
    analysis/matrices/matrices.hpp analysis/matrices/operators.hpp analysis/matrices/contact_rows.hpp
    study/pod/pod.hpp study/reduce/reduce.hpp io/run_reader.hpp
    road/crg/crg_reader.hpp road/road_report.hpp
    mesh/mesh.hpp mesh/disk.hpp mesh/gmsh_reader.hpp
    fem/elasticity.hpp fem/assembly.hpp fem/sector_stiffness.hpp fem/stress.hpp
    contact/ground.hpp model/model.hpp model/friction_work.hpp model/integrator.hpp model/internal_force.hpp
    model/stability/critical_step.hpp
    integrators/integrator.hpp integrators/start.hpp)
set(RONDO_INCLUDED_HEADERS
    core/complex.hpp core/contract.hpp core/exact_sums.hpp core/field.hpp core/ground_frame.hpp core/index.hpp core/sum.hpp core/vec2.hpp core/vec3.hpp
    case/analysis_kinds.hpp case/inflation_case.hpp case/inflation_figures.hpp analysis/modes/standing.hpp
    analysis/build/bodies.hpp io/h5/h5.hpp io/h5/hash.hpp
    fem/element.hpp fem/nodal_dilatation.hpp fem/rubber.hpp fem/viscosity.hpp
    fem/finite/cord_face.hpp fem/finite/energy.hpp fem/finite/swept_forces.hpp fem/finite/swept_section.hpp
    fem/finite/swept_rubber.hpp fem/finite/take_block.hpp fem/solid/hexahedron.hpp
    fem/hyperelastic/numbers.hpp fem/hyperelastic/laws.hpp fem/hyperelastic/branch.hpp
    fem/hyperelastic/element.hpp fem/hyperelastic/stress.hpp modal/critical_speeds.hpp modal/modes.hpp
    contact/box_tree.hpp contact/friction.hpp contact/friction_table.hpp contact/law.hpp contact/space/edge_axes.hpp contact/obstacle.hpp contact/space/space_ground.hpp contact/coupled/band.hpp contact/coupled/block.hpp contact/coupled/coupled.hpp
    contact/coupled/problem_file.hpp
    road/axis.hpp road/road.hpp road/road_part.hpp road/surface.hpp
    model/contact_node.hpp model/ledger.hpp model/material_report.hpp model/motion.hpp model/rim_body.hpp
    model/saved_state.hpp model/scheme.hpp model/subdomains.hpp)
