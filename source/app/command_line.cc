#include <snug/app/command_line.h>
#include <snug/base/errors.h>
#include <snug/base/values.h>

#include <stdexcept>

namespace snug::app {
namespace {
/// This class reads the arguments one by one.
class ArgumentReader
{
public:
  ArgumentReader(int argc, const char *const *argv)
  {
    for (int i = 1; i < argc; ++i)
      arguments.emplace_back(argv[i]);
  }

  Options read()
  {
    while (next < arguments.size())
      {
        const std::string &argument = arguments[next++];
        if (argument.size() > 1 && argument[0] == '-')
          read_option(argument);
        else if (options.file.empty() && !argument.empty())
          options.file = argument;
        else
          throw InputError("unexpected argument '" + argument + "', one parameter file is allowed" +
                           hint());
      }
    if (options.ranks > 0 && !options.estimate)
      throw InputError(
        "option '--ranks' requires --estimate; mpirun sets the number of ranks of a run" + hint());
    const bool needs_no_file = options.print_parameters || options.help || options.version;
    if (options.file.empty() && !needs_no_file)
      throw InputError("no parameter file" + hint());
    if (options.advise + options.estimate + options.validate + options.restart + options.translate +
          options.serve >
        1)
      throw InputError("only one of --advise, --estimate, --serve, --validate, --restart and "
                       "--translate is allowed" +
                       hint());
    return options;
  }

private:
  static std::string hint() { return " (snug --help)"; }

  void read_option(const std::string &argument)
  {
    const auto        equals = argument.find('=');
    const std::string name   = argument.substr(0, equals);
    if (name == "--set")
      options.sets.push_back(value_of(argument, equals));
    else if (name == "--output")
      options.output = value_of(argument, equals);
    else if (name == "--leave-out")
      options.leave_out = value_of(argument, equals);
    else if (name == "--petsc")
      options.petsc +=
        (options.petsc.empty() ? "" : " ") + petsc_options(value_of(argument, equals));
    else if (name == "--ranks")
      options.ranks = rank_number(value_of(argument, equals));
    else if (bool *flag = flag_called(name))
      {
        const bool takes_json = flag == &options.validate || flag == &options.print_parameters;
        const bool json       = takes_json && argument.substr(name.size()) == "=json";
        if (equals != std::string::npos && !json)
          throw InputError("option '" + name + "' takes no value" +
                           (takes_json ? " except 'json'" : "") + hint());
        options.json |= json;
        *flag = true;
      }
    else
      throw InputError("unknown option '" + argument + "'" + hint());
  }

  static std::string petsc_options(const std::string &text)
  {
    auto trimmed = trim(text);
    if (trimmed.size() < 2 || trimmed[0] != '-')
      throw InputError("option '--petsc' needs options of PETSc, as \"-NAME VALUE\", not '" + text +
                       "'" + hint());
    return trimmed;
  }

  static unsigned int rank_number(const std::string &text)
  {
    unsigned int number = 0;
    try
      {
        from_text(text, number);
      }
    catch (const std::invalid_argument &)
      {}
    if (number == 0)
      throw InputError("option '--ranks' needs a whole number of at least 1" + hint());
    return number;
  }

  bool *flag_called(const std::string &name)
  {
    if (name == "--restart")
      return &options.restart;
    if (name == "--validate")
      return &options.validate;
    if (name == "--advise")
      return &options.advise;
    if (name == "--estimate")
      return &options.estimate;
    if (name == "--translate")
      return &options.translate;
    if (name == "--serve")
      return &options.serve;
    if (name == "--print-parameters")
      return &options.print_parameters;
    if (name == "--help" || name == "-h")
      return &options.help;
    return name == "--version" ? &options.version : nullptr;
  }

  /// Return the text behind the equals sign, or the next argument.
  std::string value_of(const std::string &argument, const std::size_t equals)
  {
    std::string value;
    if (equals != std::string::npos)
      value = argument.substr(equals + 1);
    else if (next < arguments.size())
      value = arguments[next++];
    if (value.empty())
      throw InputError("option '" + argument.substr(0, equals) + "' needs a value" + hint());
    return value;
  }

  std::vector<std::string> arguments;
  std::size_t              next = 0;
  Options                  options;
};
} // namespace

Options parse(const int argc, const char *const *argv)
{
  return ArgumentReader(argc, argv).read();
}

std::string usage()
{
  return R"(Usage: snug FILE.prm [OPTION]...
  or:  snug --validate[=json] FILE.prm
  or:  snug --advise FILE.prm
  or:  snug --estimate [--ranks N] FILE.prm
  or:  snug --serve FILE.prm
  or:  snug --translate FILE.inp | FILE.step | FILE.json | FILE.prm
  or:  snug --print-parameters[=json] | --help | --version

Shape optimization of elastic bodies in contact, with or without friction. FILE.prm may
also be a deck of Abaqus or CalculiX (.inp), which is translated and run, or a model in
JSON.
    mpirun -np 4 snug FILE.prm    run on 4 MPI ranks

    --set "Subsection/Entry=value"
                        change an entry of the file, for example
                        --set "Body punch/Box cells=4, 4, 4" --set Task=state
    --output DIR        set the output directory
    --petsc "-NAME VALUE ..."
                        set options of PETSc, for example another package for K^+:
                        --petsc "-kplus_pc_factor_mat_solver_type mumps"
    --leave-out "plastic, equation"
                        run the model of a deck without these of its parts, which have
                        no translation
    --restart           continue an interrupted optimization
    --validate          check the file, list bodies and boundaries with areas and
                        bounding boxes, and contact pairs with gaps, without a solve;
                        with --output the meshes are written to DIR/model; =json prints
                        this, or the error, as JSON (doc/json.md)
    --advise            solve the first state and list simplifications of the model
                        (symmetry, rigid bodies, needless cells) and defects (locking)
    --estimate          make the meshes and print the memory and the time of a run;
                        --ranks N for runs on N MPI ranks
    --serve             answer requests, JSON lines of standard input, on standard output:
                        values and gradients of designs for scripts and optimizers
                        (doc/serve.md)
    --translate         print the parameter file of a deck of Abaqus or CalculiX, and
                        the keywords that are not translated, with their lines; or of
                        the solids of a CAD file, to which loads are to be added; or of
                        a model, with all entries
    --print-parameters  print all entries, their defaults and meanings (Markdown);
                        =json prints a JSON Schema of models in JSON
    --help, --version

Exit status: 0 complete; 2 the input is wrong; 3 the problem has no solution or was
not solved to its tolerance; 1 any other error. An optimization that is interrupted
or reaches its maximum number of evaluations ends with 0 if its design satisfies the
constraints, otherwise with 3. Options of PETSc are also read from the environment
variable PETSC_OPTIONS; unused options are listed at the end (doc/cluster.md).
)";
}
} // namespace snug::app
