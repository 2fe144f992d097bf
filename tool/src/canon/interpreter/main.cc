/* Runs a program through LinuxCNC's interpreter (librs274) and prints what it asks of the machine, one call a line, with
 * all digits (rs274 prints four decimals).
 *
 *   interpreter FILE [PARAMETERS [SETTINGS]]
 *
 * PARAMETERS is the file of numbered parameters; it is written anew at the end, so the caller gives a copy. SETTINGS is
 * what an INI file says of the machine, see settings.cc; what the interpreter itself takes from an INI file it reads
 * there, by the variable INI_FILE_NAME of the environment.
 * The calls themselves are in calls.cc. READ comes once before those of a file of subroutines: it is the name of the file. These
 * files count from 1 in this order, the program is 0.
 * A refusal is printed as two lines, REFUSED with line number and message, SOURCE
 * with the text of the line, and the exit code is 1. The number is a line of FILE, also where the text is of a subroutine in
 * another file: then it is the line that called it, and that file stands before the text.
 *
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <poll.h>
#include <string>
#include <sys/prctl.h>
#include <unistd.h>
#include "interp_base.hh"
#include "interp_return.hh"
#include "calls.hh"
#include "state.hh"

/* The interpreter's own Python module, which it imports when it is made. */
struct _object;
extern "C" _object *PyInit_interpreter(void);
struct _inittab {
    const char *name;
    _object *(*start)(void);
};
extern "C" {
_inittab builtin_modules[] = {{"interpreter", PyInit_interpreter}, {nullptr, nullptr}};
}

/* Tells remapped codes that no task controller is there. */
int _task = 0;

static std::string one_line(const char *text)
{
    std::string line(text);
    for (char &c : line)
        if (c == '\n' || c == '\r')
            c = ' ';
    return line;
}

/* The program, and its line that was read last. */
static const char *program;
static int program_line;

/* The name of another file that the interpreter reads a subroutine from, or nothing. */
static std::string subroutine_file(InterpBase &interpreter)
{
    char path[4096] = "";
    if (interpreter.call_level() == 0)
        return "";
    interpreter.file_name(path, sizeof path);
    std::string name(path);
    return name == program ? "" : name.substr(name.rfind('/') + 1);
}

/* Notes which file is read, and tells each file of subroutines once. */
static void note_file(InterpBase &interpreter)
{
    static std::map<std::string, int> numbers;
    now.file = 0;
    if (subroutine_file(interpreter).empty())
        return;
    char path[4096] = "";
    interpreter.file_name(path, sizeof path);
    auto [known, is_new] = numbers.emplace(path, numbers.size() + 1);
    now.file = known->second;
    if (!is_new)
        return;
    char *whole = realpath(path, nullptr);
    fprintf(output, "READ %s\n", one_line(whole ? whole : path).c_str());
    free(whole);
}

static void note_line(InterpBase &interpreter)
{
    if (subroutine_file(interpreter).empty())
        program_line = interpreter.sequence_number();
}

/* The text of the line that is carried out, or of the program's line that could not be read. What looks for a subroutine leaves
 * the interpreter at the end of the file. */
static std::string line_carried_out;

/* Before that text: the file of subroutines where it is none of the program, and the line there, if that is known. */
static std::string place_carried_out;

static std::string text_of(int number)
{
    char line[1024] = "";
    FILE *file = fopen(program, "r");
    for (int at = 0; file && at < number; at += strchr(line, '\n') != nullptr)
        if (!fgets(line, sizeof line, file))
            break;
    if (file)
        fclose(file);
    return line;
}

static std::string line_text(InterpBase &interpreter)
{
    char line[1024] = "";
    interpreter.line_text(line, sizeof line);
    return line;
}

/* Whether the program was handed to the interpreter: before its first line the text that the interpreter has is none of it. */
static bool opened;

static int print_refusal(InterpBase &interpreter, int number, const std::string &message)
{
    std::string line = line_carried_out.empty() ? line_text(interpreter) : line_carried_out;
    if (opened && number == 0)
        line.clear();
    if (!line.empty())
        line = place_carried_out + line;
    fprintf(output, "REFUSED %d %s\n", number, one_line(message.c_str()).c_str());
    fprintf(output, "SOURCE %s\n", one_line(line.c_str()).c_str());
    return 1;
}

/* `what` stands before the message. With an error the interpreter has left all subroutines already. */
static int refuse(InterpBase &interpreter, int status, const char *what = "")
{
    char message[1024] = "";
    interpreter.error_text(status, message, sizeof message);
    if (!message[0])
        snprintf(message, sizeof message, "the interpreter gives up with code %d", status);
    /* Behind a remapped code it is 0. */
    int number = interpreter.sequence_number();
    return print_refusal(interpreter, number ? number : program_line, std::string(what) + message);
}

static bool failed(int status)
{
    return status > INTERP_MIN_ERROR;
}

/* Where X Y Z become the tool centre point, or cease to be it, in the middle of a program. */
static const char tool_centre[] = "a switch of the tool centre point (write G43 in place of G43.4, leave out o<tool_centre_off>, and plan "
                                  "with --tool-centre-point, or --kinematics-type behind inner=)";
static bool sent_by_tool_centre;

/* Whether the line that was read hands a frame to framekins: its subroutine frame_send, on behalf of any but those that
 * take a frame away. Without HAL it would return at once, and the frame would be passed over in silence. */
static bool sends_frame(InterpBase &interpreter)
{
    static std::string caller;
    std::string name = subroutine_file(interpreter);
    if (name.empty())
        sent_by_tool_centre = false;
    else if (name == "code_tool_centre.ngc" || name == "tool_centre_off.ngc")
        sent_by_tool_centre = true;
    if (name != "frame_send.ngc") {
        caller = name;
        return false;
    }
    return caller != "frame_off.ngc" && caller != "frame_suspend.ngc" && caller != "frame_resume.ngc";
}

static int unsupported(InterpBase &interpreter, const char *what, std::string place = "")
{
    std::string file = subroutine_file(interpreter);
    if (!file.empty())
        place = "in " + file + ", line " + std::to_string(interpreter.sequence_number()) + ": ";
    place_carried_out.clear();
    return print_refusal(interpreter, program_line, place + what + " is not supported here");
}

/* Tells once that a block is carried out which an operator may have left out. */
static void note_slash(const std::string &line)
{
    static bool told;
    size_t first = line.find_first_not_of(" \t");
    if (told || now.block_delete || first == std::string::npos || line[first] != '/')
        return;
    fputs("SLASH\n", output);
    told = true;
}

static int interpret(InterpBase &interpreter, const char *file)
{
    program = file;
    int status = interpreter.init();
    if (failed(status))
        return refuse(interpreter, status);
    if (!machine.startup.empty()) {
        status = interpreter.execute(machine.startup.c_str());
        if (failed(status))
            return refuse(interpreter, status, "[RS274NGC]RS274NGC_STARTUP_CODE: ");
        if (unsupported_call())
            return unsupported(interpreter, unsupported_call(), "[RS274NGC]RS274NGC_STARTUP_CODE: ");
    }
    opened = true;
    status = interpreter.open(file);
    if (failed(status))
        return refuse(interpreter, status);
    for (;;) {
        std::string file = subroutine_file(interpreter);
        line_carried_out.clear();
        place_carried_out = file.empty() ? "" : file + ": ";
        status = interpreter.read();
        if (status == INTERP_ENDFILE || status == INTERP_EXIT)
            break;
        if (failed(status) && file.empty())
            line_carried_out = text_of(interpreter.sequence_number());
        if (failed(status))
            return refuse(interpreter, status);
        note_line(interpreter);
        note_file(interpreter);
        line_carried_out = line_text(interpreter);
        file = subroutine_file(interpreter);
        place_carried_out = file.empty() ? "" : file + ", line " + std::to_string(interpreter.sequence_number()) + ": ";
        look_for_answer(line_carried_out.c_str());
        note_slash(line_carried_out);
        if (sends_frame(interpreter))
            return unsupported(interpreter, sent_by_tool_centre ? tool_centre : "a programmed frame (framekins)");
        if (status == INTERP_OK)
            status = interpreter.execute();
        if (failed(status))
            return refuse(interpreter, status);
        if (unsupported_call())
            return unsupported(interpreter, unsupported_call());
        if (status == INTERP_EXIT)
            break;
        /* The program wants to know the state of the machine at this point: all motion counts as done. */
        if (status == INTERP_EXECUTE_FINISH && failed(status = interpreter.synch()))
            return refuse(interpreter, status);
    }
    interpreter.close();
    return 0;
}

/* The end of whoever reads the calls is the end of this, in the middle of a loop of the program, too. */
static void end_with_reader()
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    /* It may have ended before. */
    pollfd reader = {STDOUT_FILENO, 0, 0};
    if (poll(&reader, 1, 0) == 1 && (reader.revents & POLLERR))
        _Exit(2);
}

int main(int count, char **arguments)
{
    if (count < 2) {
        fputs("usage: interpreter FILE [PARAMETERS [SETTINGS]]\n", stderr);
        return 2;
    }
    end_with_reader();
    /* Programs may print, too: (PRINT, ..) goes to where errors go. */
    output = fdopen(dup(STDOUT_FILENO), "w");
    if (!output || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        perror("interpreter");
        return 2;
    }
    static char buffer[1 << 16];
    setvbuf(output, buffer, _IOFBF, sizeof buffer);
    if (count > 2)
        parameter_file(arguments[2]);
    if (count > 3 && !read_settings(arguments[3])) {
        fprintf(stderr, "interpreter: %s cannot be read\n", arguments[3]);
        return 2;
    }
    fprintf(output, "UNIT %.17g\n", now.unit);
    InterpBase *interpreter = makeInterp();
    refuse_python();
    int result = interpret(*interpreter, arguments[1]);
    if (result == 0)
        fputs("END\n", output);
    /* Straight out: the destructors of Python's objects gain nothing here. */
    if (fflush(output))
        result = 3;
    _Exit(result);
}
