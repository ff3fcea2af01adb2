#include <snug/app/interrupt.h>
#include <snug/app/optimize.h>
#include <snug/app/study.h>

#include <iomanip>
#include <ostream>

namespace snug
{
  namespace app
  {
    namespace
    {
      void
      print_certificate(std::ostream &out, const state::Certificate &errors)
      {
        out << "certificate: equilibrium " << errors.equilibrium
            << ", continuity " << errors.continuity << ", penetration "
            << errors.penetration << ", negative pressure "
            << errors.negative_pressure << ", complementarity "
            << errors.complementarity << std::endl;
      }

      template <int dim>
      void
      print_state(std::ostream &out, const state::ContactState<dim> &state)
      {
        out << "energy " << state.energy << ", compliance " << state.compliance
            << ", strain energy " << state.strain_energy << "\ncontact force ("
            << state.contact_force << "), area " << state.contact_area
            << ", peak pressure " << state.max_pressure << ", "
            << state.active_contacts << " active and " << state.weak_contacts
            << " weakly active of " << state.contact.size() << " contact rows\n"
            << state.dual.method << ": " << state.dual.outer_iterations
            << " outer iterations, " << state.f_mults << " F-mults\n";
        print_certificate(out, state.certificate);
      }

      template <int dim>
      state::ContactState<dim>
      solve_start(Workshop<dim> &workshop)
      {
        workshop.context.progress("solving the contact problem ...");
        auto state = workshop.solve(workshop.basis->start(), qp::WarmStart());
        if (workshop.scene.report_linear_reference)
          state.linear_f_mults = workshop.solver->linear_f_mults(state);
        print_state(workshop.context.out(), state);
        return state;
      }

      template <int dim>
      int
      run_state(Workshop<dim> &workshop)
      {
        const auto state = solve_start(workshop);
        workshop.draw(0., state);
        io::Summary summary;
        summary.task  = "state";
        summary.state = io::summarize(state);
        workshop.write_summary(summary);
        return 0;
      }

      /// The methods of a sensitivity table: name in the table, method and
      /// how K', f', B', g' are taken.
      struct Method
      {
        std::string name, method, derivatives;
      };

      template <int dim>
      std::vector<Method>
      methods_of(const response::Response<dim> &response)
      {
        std::vector<Method> methods;
        if (response.stationary() || !response.needs_solution())
          methods.push_back({"energy", "energy", "exact"});
        if (response.needs_solution())
          {
            methods.push_back({"adjoint", "adjoint", "exact"});
            methods.push_back({"direct", "direct", "exact"});
            methods.push_back(
              {"semi-analytic", "direct", "finite differences"});
          }
        // last: they leave the solver at another design
        methods.push_back(
          {"finite differences", "finite differences", "exact"});
        return methods;
      }

      void
      print_table(std::ostream                                &out,
                  const std::vector<io::Summary::GradientRow> &rows)
      {
        const int name_width = 20, width = 17;
        out << std::left << std::setw(name_width) << "method" << std::right;
        for (const auto &row : rows)
          out << std::setw(width + 2) << row.method;
        const auto line = [&](const std::string &name, const auto &value) {
          out << '\n'
              << std::left << std::setw(name_width) << name << std::right;
          for (const auto &row : rows)
            out << "  " << std::setw(width) << value(row);
        };
        const auto precision = out.precision(9);
        for (unsigned int j = 0; j < rows.front().values.size(); ++j)
          line("dJ/dalpha_" + std::to_string(j),
               [&](const auto &row) { return row.values[j]; });
        out.precision(3);
        line("F-mults", [](const auto &row) { return row.f_mults; });
        line("factorizations",
             [](const auto &row) { return row.numeric_factorizations; });
        line("seconds", [](const auto &row) { return row.seconds; });
        out << std::endl;
        out.precision(precision);
      }

      template <int dim>
      int
      run_sensitivity(Workshop<dim> &workshop)
      {
        const auto state  = solve_start(workshop);
        const auto design = workshop.basis->start();
        workshop.draw(0., state);
        io::Summary summary;
        summary.task  = "sensitivity";
        summary.state = io::summarize(state);
        io::Summary::Gradient gradient;
        for (const Method &method : methods_of(*workshop.objective))
          {
            workshop.context.progress("gradient by " + method.name + " ...");
            auto parameters        = workshop.scene.gradient;
            parameters.method      = method.method;
            parameters.derivatives = method.derivatives;
            const auto result = workshop.gradients({workshop.objective.get()},
                                                   state,
                                                   design,
                                                   parameters);
            gradient.methods.push_back({method.name,
                                        result.f_mults,
                                        result.numeric_factorizations,
                                        result.seconds,
                                        result.of_response[0].values});
          }
        const auto &wanted = workshop.scene.gradient.method;
        for (const auto &row : gradient.methods)
          if (row.method == wanted ||
              (wanted == "auto" && gradient.method.empty()))
            static_cast<io::Summary::GradientRow &>(gradient) = row;
        summary.gradient = gradient;
        print_table(workshop.context.out(), gradient.methods);
        workshop.write_summary(summary);
        return 0;
      }

      template <int dim>
      int
      run_task(RunContext         &context,
               const scene::Scene &scene,
               const Options      &options)
      {
        Workshop<dim> workshop(context, scene);
        workshop.print_header();
        int status = 0;
        switch (scene.task)
          {
            case scene::Task::state:
              status = run_state(workshop);
              break;
            case scene::Task::sensitivity:
              status = run_sensitivity(workshop);
              break;
            case scene::Task::optimize:
              status = Optimize<dim>(workshop, options.restart).run();
              break;
          }
        context.out() << "results in " << scene.output_directory << ", "
                      << context.seconds() << " s" << std::endl;
        return status;
      }
    } // namespace

    int
    run_study(RunContext         &context,
              const scene::Scene &scene,
              const Options      &options)
    {
      catch_interrupts();
      return scene.dimension == 2 ? run_task<2>(context, scene, options)
                                  : run_task<3>(context, scene, options);
    }
  } // namespace app
} // namespace snug
