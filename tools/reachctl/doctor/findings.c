#include "tools/reachctl/doctor/findings.h"

#include <stdarg.h>

static const char *const words[] = {"ok", "FINDING", "skipped"};
static const char *const json_words[] = {"ok", "finding", "skipped"};

void findings_add(struct findings *findings, enum verdict verdict, const char *check,
                  const char *format, ...)
{
    struct finding *finding = &findings->list[findings->n];
    va_list arguments;

    if (findings->n == FINDINGS_MOST)
        return;
    findings->n++;
    finding->check = check;
    finding->verdict = verdict;
    finding->remedy[0] = '\0';
    va_start(arguments, format);
    vsnprintf(finding->text, sizeof finding->text, format, arguments);
    va_end(arguments);
}

void findings_remedy(struct findings *findings, const char *format, ...)
{
    struct finding *newest = &findings->list[findings->n - 1];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(newest->remedy, sizeof newest->remedy, format, arguments);
    va_end(arguments);
}

bool findings_all_well(const struct findings *findings)
{
    for (int i = 0; i < findings->n; i++)
        if (findings->list[i].verdict == VERDICT_FINDING)
            return false;
    return true;
}

void findings_print(const struct findings *findings, FILE *out)
{
    for (int i = 0; i < findings->n; i++) {
        const struct finding *finding = &findings->list[i];
        fprintf(out, "%-8s %-16s %s\n", words[finding->verdict], finding->check, finding->text);
        if (finding->remedy[0])
            fprintf(out, "%-8s %-16s   mend: %s\n", "", "", finding->remedy);
    }
}

static void print_text(const char *text, FILE *out)
{
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fprintf(out, "\\%c", *text);
        else if ((unsigned char)*text < 0x20)
            fprintf(out, "\\u%04x", (unsigned int)(unsigned char)*text);
        else
            fputc(*text, out);
    }
    fputc('"', out);
}

void findings_print_json(const struct findings *findings, FILE *out)
{
    for (int i = 0; i < findings->n; i++) {
        const struct finding *finding = &findings->list[i];
        fprintf(out, "%s{\"check\": \"%s\", \"verdict\": \"%s\", \"text\": ", i ? ",\n " : "[",
                finding->check, json_words[finding->verdict]);
        print_text(finding->text, out);
        fputs(", \"remedy\": ", out);
        print_text(finding->remedy, out);
        fputc('}', out);
    }
    fputs(findings->n ? "]\n" : "[]\n", out);
}
