// solve_scene FILE.prm: the potential energy of a scene in 3D, at its
// reference geometry and its first load case.
#include <snug/app/build_model.h>
#include <snug/mesh/tearing.h>
#include <snug/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <iostream>

int main(int argc, char *argv[])
{
  using namespace snug;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto            read      = [](const std::string &file) { return scene::read_text(file); };
  const auto            scene     = scene::read_scene({argv[1], read(argv[1]), {}, "", read});
  const auto            mesh      = app::build_mesh<3>(scene, MPI_COMM_WORLD);
  const auto            tearing   = mesh::tear(*mesh);
  const auto            positions = mesh->reference_positions();
  const auto            model     = app::build_model(scene, *mesh);
  RunContext            context(MPI_COMM_WORLD, std::clog);
  state::StateSolver<3> solver(*mesh, tearing, model, positions, context);
  const auto            state = solver.solve(positions, qp::WarmStart());
  if (context.rank() == 0)
    {
      std::cout.precision(17);
      std::cout << state.energy << std::endl;
    }
}
